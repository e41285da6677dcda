#include "gui/app/edit_history.h"

#include <QUndoCommand>
#include <utility>

#include "base/error.h"
#include "gui/widgets/fault_words.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::gui::app {

class EditHistory::Change : public QUndoCommand {
 public:
  Change(EditHistory& history, State before, State after, const QString& what)
      : QUndoCommand(what), history_(history), before_(std::move(before)), after_(std::move(after)) {}
  void redo() override {
    if (!std::exchange(fresh_, false)) restore(after_);  // what is pushed has been done already
  }
  void undo() override { restore(before_); }
  // A slider's way is one change.
  int id() const override { return text() == QLatin1String("shape") ? 1 : -1; }
  bool mergeWith(const QUndoCommand* other) override {
    after_ = static_cast<const Change*>(other)->after_;
    return true;
  }

 private:
  void restore(const State& state) {
    history_.session_.setProgramme(state.programme);
    history_.opened_ = state.opened;
  }
  bool fresh_ = true;
  EditHistory& history_;
  State before_, after_;
};

bool EditHistory::isSameScene(experiment::Experiment changed) const {
  changed.text = session_.experiment().text;
  return changed == session_.experiment();
}

QStringList EditHistory::tryEdit(const experiment::Experiment& changed, const QString& what) {
  const bool sameLook = experiment::lookOf(changed) == experiment::lookOf(session_.experiment());
  if (isSameScene(changed) && sameLook) return {};  // back to what holds: the run goes on
  const State before = now();
  try {
    const QStringList faults = widgets::inWords(session_.tryEdit(changed));
    if (faults.isEmpty()) push(before, what);
    return faults;
  } catch (const Error& e) {
    return {QString::fromUtf8(e.what())};
  }
}

void EditHistory::open(const session::Programme& programme, const QString& what, const Opened& opened) {
  State before = now();
  session_.setProgramme(programme);
  opened_ = opened;
  push(std::move(before), what);
}

void EditHistory::push(State before, const QString& what) { stack_.push(new Change(*this, std::move(before), now(), what)); }

}  // namespace reachlab::gui::app
