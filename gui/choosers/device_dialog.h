#pragma once
#include <QDialog>
#include <functional>
#include <memory>

#include "devices/live_device.h"
#include "gui/choosers/device_view.h"
#include "gui/widgets/qt_names.h"

namespace reachlab::gui::docks {

/// Whether the device of this name, with its options, is seen only in the window itself, as the mouse is.
bool isInWindowOnly(const QString& device);
/// Whether this is the bare name of a driver that needs more, as `replay` needs a file.
bool needsMoreThanItsName(const QString& device);

/// A device live: its place, the force on it, how regularly it reports, and its calibration. No object is held.
class DeviceDialog : public QDialog {
 public:
  /// `take`: is told the device that is to be the hand.
  DeviceDialog(const experiment::CompiledExperiment& experiment, const QString& chosen, std::function<void(const QString& name)> take,
               QWidget* parent);
  /// Opens the named device, or releases it.
  void openOrLetGo();

 private:
  void look();
  void calibrate();
  void showButtons();
  void tell(const QString& sentence, bool isFault);

  experiment::CompiledExperiment experiment_;
  std::function<void(const QString& name)> taken_;
  QLineEdit* name_;
  QPushButton *open_, *calibrate_, *take_;
  DeviceView* view_;
  QLabel *numbers_, *hint_;
  QTimer* timer_;
  std::unique_ptr<devices::LiveDevice> device_;
  QString usual_;      // the hint while the device is well
  std::string fault_;  // of the device at the last look
  double reach_ = 0.1, force_ = 1;
};

}  // namespace reachlab::gui::docks
