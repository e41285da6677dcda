#pragma once
#include <map>
#include <string>

#include "gui/docks/dock.h"
#include "sim/haptics/run_conductor.h"
#include "sim/session/session.h"

class QCheckBox;
class QComboBox;
class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;
class QVBoxLayout;

namespace reachlab::gui::widgets {
class UnitSpinBox;
}  // namespace reachlab::gui::widgets

namespace reachlab::gui::docks {

/// Subject, session, run, day, device, the buttons of trials, the tally, and notes.
class SessionDock : public Dock {
  Q_OBJECT
 public:
  explicit SessionDock(QWidget* parent = nullptr);

  void setRequest(const session::SessionRequest& request);
  /// The typed values. `what`, `fast` and similar members are unchanged.
  session::SessionRequest request() const;
  /// The faults of the fields, one line each, as shown under them. Empty if there is no fault.
  QString fault() const;
  std::string device() const;
  void setDevice(const QString& name);
  bool repeatsByItself() const;  // next trial without a key
  double pauseSeconds() const;   // [s] before it

  /// While a run is open, the fields of subject and session are fixed. BlockDone: the plan has a next block. Following: another station
  /// conducts.
  enum class Stage { Closed, BetweenTrials, UnderWay, BlockDone, Finished, Following };
  void setStage(Stage stage);
  /// Which run is open: its number, block, condition, day, seed.
  void showRun(const record::RunConfiguration& run);
  void clearTally();
  void count(const trial::TrialResult& result);
  /// Puts the cursor into the line for notes, behind these words.
  void beginNote(const QString& words);

 Q_SIGNALS:
  void nextRequested();
  void abortRequested();
  void repeatRequested();
  void endRequested();
  void noteWritten(const QString& text);
  void deviceChanged();
  /// Which devices there are is to be seen.
  void devicesRequested();

 protected:
  /// A plan has its own numbers of trials.
  void display(const experiment::CompiledExperiment& experiment, bool editable) override;

 private:
  QWidget* makeWho();
  QHBoxLayout* makeDeviceRow();
  void addRun(QVBoxLayout& layout);
  void wire();
  void check();
  void offerPlugged();

  session::SessionRequest request_;
  QLineEdit *subject_, *session_, *data_, *note_, *age_;
  QComboBox *device_, *sex_, *hand_;
  QSpinBox *trials_, *day_;
  QCheckBox* automatic_;
  widgets::UnitSpinBox* pause_;
  QWidget* who_;
  QLabel *run_, *tally_;
  QPushButton *next_, *abort_, *repeat_, *end_;
  int successes_ = 0, failures_ = 0, others_ = 0;
  std::map<trial::Reason, int> reasons_;
  std::uint64_t plugged_ = 0;  // devices::pluggedFingerprint
  int offered_ = 0;            // entries of `device_` that are always there
};

}  // namespace reachlab::gui::docks
