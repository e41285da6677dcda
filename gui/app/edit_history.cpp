#include "gui/app/edit_history.h"

#include <QUndoCommand>
#include <utility>

#include "base/error.h"
#include "gui/widgets/fault_words.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::gui::app {
namespace {

class Change : public QUndoCommand {
 public:
  Change(SessionController& session, session::Programme before, session::Programme after, const QString& what)
      : QUndoCommand(what), session_(session), before_(std::move(before)), after_(std::move(after)) {}
  void redo() override {
    if (!std::exchange(fresh_, false)) session_.setProgramme(after_);  // what is pushed has been done already
  }
  void undo() override { session_.setProgramme(before_); }
  // A slider's way is one change.
  int id() const override { return text() == QLatin1String("shape") ? 1 : -1; }
  bool mergeWith(const QUndoCommand* other) override {
    after_ = static_cast<const Change*>(other)->after_;
    return true;
  }

 private:
  bool fresh_ = true;
  SessionController& session_;
  session::Programme before_, after_;
};

}  // namespace

bool EditHistory::isSameScene(experiment::Experiment changed) const {
  changed.text = session_.experiment().text;
  return changed == session_.experiment();
}

QStringList EditHistory::tryEdit(const experiment::Experiment& changed, const QString& what) {
  const bool sameLook = experiment::lookOf(changed) == experiment::lookOf(session_.experiment());
  if (isSameScene(changed) && sameLook) return {};  // back to what holds: the run goes on
  const session::Programme before = session_.programme();
  try {
    const QStringList faults = widgets::inWords(session_.tryEdit(changed));
    if (faults.isEmpty()) push(before, what);
    return faults;
  } catch (const Error& e) {
    return {QString::fromUtf8(e.what())};
  }
}

void EditHistory::open(const session::Programme& programme, const QString& what) {
  const session::Programme before = session_.programme();
  session_.setProgramme(programme);
  push(before, what);
}

void EditHistory::push(const session::Programme& before, const QString& what) {
  stack_.push(new Change(session_, before, session_.programme(), what));
}

}  // namespace reachlab::gui::app
