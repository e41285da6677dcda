#pragma once
#include <QPointer>
#include <cstdint>
#include <optional>
#include <vector>

#include "devices/driver/registry.h"
#include "devices/hot_plug.h"
#include "gui/choosers/device_dialog.h"
#include "gui/docks/dock.h"
#include "gui/widgets/qt_names.h"

namespace reachlab::gui::docks {

/// Lists the present devices, and the missing devices with a reason. Plugging shows by itself while the dock is visible and no run has the
/// devices. Drivers are asked in the window's thread, and some drivers open a device for a moment.
class DeviceDock : public Dock {
  Q_OBJECT
 public:
  /// How devices are found.
  struct Finding {
    std::uint64_t (*fingerprint)() = devices::pluggedFingerprint;
    std::vector<devices::FoundDevice> (*all)() = devices::findDevices;
  };
  explicit DeviceDock(QWidget* parent = nullptr) : DeviceDock(Finding{}, parent) {}
  DeviceDock(const Finding& finding, QWidget* parent);

  /// Tells that a run has its devices. Then no driver is asked and no device is opened.
  void setBusy(bool busy);
  /// The device that is the hand now. Its options stay when its device is looked at or chosen again.
  void setHand(const QString& hand) { hand_ = hand; }
  /// Asks every driver anew.
  void list();
  QString chosen() const;  // the name that opens it; empty: no row

 Q_SIGNALS:
  /// It is to be the hand.
  void taken(const QString& name);

 private:
  bool mayAsk() const;
  QString withOptions(const QString& name) const;
  void showButtons();
  void lookAt();

  Finding finding_;
  QTreeWidget* rows_;
  QLabel* hint_;
  QPushButton *take_, *look_, *again_;
  QPointer<DeviceDialog> dialog_;
  QString hand_;
  std::optional<std::uint64_t> plugged_;  // fingerprint of what the list is of; none: it was never asked for
  bool busy_ = false;
};

}  // namespace reachlab::gui::docks
