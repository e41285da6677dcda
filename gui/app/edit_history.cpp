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
  Change(EditHistory& history, session::Programme before, const QString& what, std::optional<Opened> openedBefore)
      : QUndoCommand(what), history_(history), before_(std::move(before)), after_(history.session_.programme()),
        otherOpened_(std::move(openedBefore)) {}
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
  void restore(const session::Programme& programme) {
    if (otherOpened_) std::swap(*otherOpened_, history_.opened_);
    history_.session_.setProgramme(programme);
  }
  bool fresh_ = true;
  EditHistory& history_;
  session::Programme before_, after_;
  std::optional<Opened> otherOpened_;  // of the other side of this change, if it opened another file
};

bool EditHistory::isSameScene(experiment::Experiment changed) const {
  changed.text = session_.experiment().text;
  return changed == session_.experiment();
}

QStringList EditHistory::tryEdit(const experiment::Experiment& changed, const QString& what) {
  const bool sameLook = experiment::lookOf(changed) == experiment::lookOf(session_.experiment());
  if (isSameScene(changed) && sameLook) return {};  // back to what holds: the run goes on
  session::Programme before = session_.programme();
  try {
    const QStringList faults = widgets::inWords(session_.tryEdit(changed));
    if (faults.isEmpty()) stack_.push(new Change(*this, std::move(before), what, std::nullopt));
    return faults;
  } catch (const Error& e) {
    return {QString::fromUtf8(e.what())};
  }
}

void EditHistory::open(const session::Programme& programme, const QString& what, Opened opened) {
  session::Programme before = session_.programme();
  Opened openedBefore = std::exchange(opened_, std::move(opened));
  session_.setProgramme(programme);
  stack_.push(new Change(*this, std::move(before), what, std::move(openedBefore)));
}

}  // namespace reachlab::gui::app
