#pragma once
#include <QDockWidget>
#include <QStringList>

#include "gui/widgets/fault_label.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {

/// A panel beside the scene: an experiment goes in, an edit comes out. Depends neither on the window nor on the session. A new dock needs
/// its files and a line in all_docks.cpp.
class Dock : public QDockWidget {
  Q_OBJECT
 public:
  /// `name`: by which the layout is remembered. The faults of "objectDock" are named "objectFaults".
  Dock(const QString& title, const QString& name, QWidget* parent);

  /// Displays the experiment and emits nothing. `editable` is false if the settings belong to a plan's file.
  void showExperiment(const experiment::CompiledExperiment& experiment, bool editable);
  /// Shows why the last edit was refused, one line per fault. An empty list means that the edit holds.
  virtual void showFaults(const QStringList& faults);
  /// The faults of the fields, one line each, as shown under them. Empty if there is no fault.
  QString fault() const { return faults_->text(); }

 Q_SIGNALS:
  /// Emitted after a change by the user, with the whole changed experiment, which may be faulty. `what` names the change: "task".
  void edited(const reachlab::experiment::Experiment& changed, const QString& what);

 protected:
  virtual void display(const experiment::CompiledExperiment&, bool /*editable*/) {}
  /// Shows the faults of the entries alone, after another experiment is displayed. For docks that check their entries themselves.
  virtual void showEntryFaults();
  /// Tells the experiment with this change: `change(experiment)`.
  template <typename Change>
  void edit(const QString& what, Change change) {
    experiment::Experiment changed = shown_;
    change(changed);
    Q_EMIT edited(changed, what);
  }
  /// `scrolls`: on a small screen the dock may be lower than its content.
  void setBody(QWidget* body, bool scrolls = true);
  QWidget* body() const { return body_; }
  const experiment::Experiment& shown() const { return shown_; }
  widgets::FaultLabel* faults() const { return faults_; }  // a dock that edits gives it a place

 private:
  experiment::Experiment shown_;
  QWidget* body_ = nullptr;
  widgets::FaultLabel* faults_;
};

}  // namespace reachlab::gui::docks
