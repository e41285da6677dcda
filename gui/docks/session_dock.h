#pragma once
#include <string>

#include "gui/docks/dock.h"
#include "gui/widgets/qt_names.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/session/session.h"

namespace reachlab::gui::docks {

/// Subject, session, day, person, device, number of trials, and folder of the dataset. Another subject empties the fields of the person.
/// It has its full height, and does not scroll.
class SessionDock : public Dock {
  Q_OBJECT
 public:
  explicit SessionDock(QWidget* parent = nullptr);

  void setRequest(const session::SessionRequest& request);
  /// The typed values. `what`, `fast` and similar members are unchanged.
  session::SessionRequest request() const;
  std::string device() const;
  void setDevice(const QString& name);
  void setTrials(int trials);
  /// The pause [s] before the next trial begins by itself. nullopt: it waits for a key.
  std::optional<double> ownPause() const;

  /// While a run is open, the fields of subject and session are fixed.
  void setOpen(bool open);
  /// Counts the subject's label up: "03" becomes "04".
  void nextSubject();

 Q_SIGNALS:
  /// A field was changed, by the user or by the program.
  void changed();
  /// Which devices there are is to be seen.
  void devicesRequested();

 protected:
  void showEntryFaults() override { check(); }
  /// A plan has its own numbers of trials.
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  QHBoxLayout* makeDeviceRow();
  void check();
  void forgetPerson();
  void offerPlugged();

  session::SessionRequest request_;
  QLineEdit *subject_, *session_, *data_, *age_;
  QComboBox *device_, *sex_, *hand_;
  QSpinBox *trials_, *day_;
  QCheckBox* automatic_;
  widgets::UnitSpinBox* pause_;
  QWidget* who_;
  std::uint64_t plugged_ = 0;  // devices::pluggedFingerprint
  int offered_ = 0;            // entries of `device_` that are always there
};

/// The next label: "03" becomes "04", "P9" becomes "P10", and "A" becomes "A2".
QString labelAfter(const QString& label);

}  // namespace reachlab::gui::docks
