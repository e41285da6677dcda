#include "gui/app/screens.h"

#include <algorithm>

#include "gui/scene/scene_view.h"
#include "gui/subject/subject_window.h"

namespace reachlab::gui::app {

Screens::Screens(scene::SceneView& main) : main_(main) { connect(&main, &scene::SceneView::handDragged, this, &Screens::handDragged); }

Screens::~Screens() { delete subject_; }

void Screens::showExperiment(const experiment::CompiledExperiment& experiment) {
  experiment_ = experiment;
  rebuild();
}

void Screens::rebuild() {
  const scene::ScenePlan plan = planScene(experiment_->experiment(), experiment_->constraint(), options_);
  frame_ = restingFrame(plan);
  main_.setPlan(plan);
  if (subject_) subject_->view().setPlan(plan);
}

void Screens::showRest() {
  frame_ = restingFrame(main_.plan());
  main_.showFrame(frame_);
  if (subject_) subject_->view().showFrame(frame_);
}

void Screens::showState(const haptics::TickState& state) {
  copyToFrame(state, frame_);
  main_.showFrame(frame_);
  if (subject_) subject_->view().showFrame(frame_);
}

void Screens::showOverlay(const scene::OverlayState& experimenters, const scene::OverlayState& subjects) {
  overlay_ = experimenters;
  subjectsOverlay_ = subjects;
  main_.setOverlay(experimenters);
  if (subject_) subject_->view().setOverlay(subjects);
}

void Screens::setSideBySide(bool on) {
  options_.sideBySide = on ? scene::ViewOptions::SideBySide::Always : scene::ViewOptions::SideBySide::Never;
  const scene::Camera kept = main_.camera();
  rebuild();
  main_.setCamera(kept);
  main_.fit();
}

bool Screens::massesHide() const {
  const std::vector<Vec3>& shifts = main_.plan().massShift;
  return shifts.size() > 1 && std::all_of(shifts.begin(), shifts.end(), [](const Vec3& s) { return s == Vec3{}; });
}

void Screens::toggleSubject() {
  if (subject_) return closeSubject();
  subject_ = new subject::SubjectWindow;
  subject_->setAttribute(Qt::WA_DeleteOnClose);
  connect(&subject_->view(), &scene::SceneView::handDragged, this, &Screens::handDragged);
  subject_->view().setPlan(main_.plan());
  subject_->view().setOverlay(subjectsOverlay_);
  subject_->addActions(actions_);
  subject_->showFull();
}

void Screens::closeSubject() {
  if (subject_) subject_->close();
}

}  // namespace reachlab::gui::app
