#pragma once
#include <QString>
#include <QStringList>
#include <QUndoStack>

#include "gui/session/session_controller.h"

namespace reachlab::gui::app {

/// Where the programme comes from.
struct Opened {
  QString what;  // file or shipped name that was opened
  QString file;  // what was opened or saved; empty: shipped or new
};

/// Changes by the user, for undo and redo. Each change holds the whole programme, checked and compiled.
class EditHistory {
 public:
  explicit EditHistory(SessionController& session) : session_(session) {}

  /// Takes the experiment over if it has no fault. Returns the faults as sentences, and an empty list if the experiment holds.
  QStringList tryEdit(const experiment::Experiment& changed, const QString& what);
  /// Whether nothing but the look of the scene differs from the present experiment.
  bool isSameScene(experiment::Experiment changed) const;
  /// Takes over a programme that was opened. Undo takes its file back with it.
  void open(const session::Programme& programme, const QString& what, Opened opened);
  const Opened& opened() const { return opened_; }
  /// After a save under another name. Undo of an edit keeps it.
  void setOpened(const Opened& opened) { opened_ = opened; }
  QUndoStack& stack() { return stack_; }

 private:
  class Change;

  SessionController& session_;
  Opened opened_;
  QUndoStack stack_;
};

}  // namespace reachlab::gui::app
