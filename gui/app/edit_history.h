#pragma once
#include <QString>
#include <QStringList>
#include <QUndoStack>

#include "sim/session/session.h"

namespace reachlab::gui::app {

class SessionController;

/// What the user changed, to be undone and redone: each change is the whole of what is to be done, checked and compiled.
class EditHistory {
 public:
  explicit EditHistory(SessionController& session) : session_(session) {}

  /// Takes the experiment over if nothing is wrong with it. What is wrong, in words; empty: it holds.
  QStringList tryEdit(const experiment::Experiment& changed, const QString& what);
  /// Takes over what was opened.
  void open(const session::Programme& programme, const QString& what);
  QUndoStack& stack() { return stack_; }

 private:
  void push(const session::Programme& before, const QString& what);

  SessionController& session_;
  QUndoStack stack_;
};

}  // namespace reachlab::gui::app
