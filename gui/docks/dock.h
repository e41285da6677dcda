#pragma once
#include <QDockWidget>
#include <QStringList>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::widgets {
class FaultLabel;
}

namespace reachlab::gui::docks {

/// A panel beside the scene: an experiment in, an edit out. Knows neither the window nor the session. A new one is a file of its own and a
/// line in all_docks.cpp.
class Dock : public QDockWidget {
  Q_OBJECT
 public:
  /// `name`: by which the layout is remembered.
  Dock(const QString& title, const QString& name, QWidget* parent);

  /// Displays what holds; emits nothing. `editable`: false where the settings are a plan's, which stand in its file.
  void showExperiment(const experiment::CompiledExperiment& experiment, bool editable);
  /// Why the last edit was refused, a line each; empty: it holds.
  virtual void showFaults(const QStringList& faults);

 Q_SIGNALS:
  /// The user changed something: the whole experiment as it is to be, perhaps faulty, and what the change is called: "task".
  void edited(const reachlab::experiment::Experiment& changed, const QString& what);

 protected:
  virtual void display(const experiment::CompiledExperiment& experiment, bool editable) = 0;
  /// `scrolls`: on a small screen the dock may be lower than what it holds.
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
