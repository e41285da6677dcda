#pragma once
#include <QToolBar>
#include <map>

#include "gui/widgets/elided_label.h"
#include "gui/widgets/qt_names.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/trial/outcome.h"

namespace reachlab::gui::app {

/// The buttons of trials, the open run with its tally, and the line for notes. A tool bar across the window, so that no dock can hide it.
class SessionStrip : public QToolBar {
  Q_OBJECT
 public:
  /// The buttons do the same as these actions, and take words and state from them.
  SessionStrip(QAction* next, QAction* abort, QAction* repeat, QAction* end);
  /// Shows number, block, condition, day and seed of the open run.
  void showRun(const record::RunConfiguration& run);
  void clearTally();
  void count(const trial::TrialResult& result);
  /// "12 of 15 succeeded (80 %), 2 aborted: 1 × too fast".
  QString tally() const;
  /// Notes can be written only while a run is open.
  void setOpen(bool open);
  /// Puts the cursor into the line for notes, behind these words.
  void beginNote(const QString& words);

 Q_SIGNALS:
  void noteWritten(const QString& text);

 private:
  widgets::ElidedLabel *run_, *tally_;
  QLineEdit* note_;
  int successes_ = 0, failures_ = 0, others_ = 0;
  std::map<trial::Reason, int> reasons_;
};

}  // namespace reachlab::gui::app
