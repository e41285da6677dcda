#pragma once
#include <QString>
#include <QStringList>
#include <QUndoStack>

#include "gui/session/session_controller.h"

namespace reachlab::gui::app {

/// Changes by the user, for undo and redo. Each change holds the whole programme, checked and compiled.
class EditHistory {
 public:
  explicit EditHistory(SessionController& session) : session_(session) {}

  /// Takes the experiment over if it has no fault. Returns the faults as sentences, and an empty list if the experiment holds.
  QStringList tryEdit(const experiment::Experiment& changed, const QString& what);
  /// Whether nothing but the look of the scene differs from the present experiment.
  bool isSameScene(experiment::Experiment changed) const;
  /// Takes over a programme that was opened.
  void open(const session::Programme& programme, const QString& what);
  QUndoStack& stack() { return stack_; }

 private:
  void push(const session::Programme& before, const QString& what);

  SessionController& session_;
  QUndoStack stack_;
};

}  // namespace reachlab::gui::app
