#include "gui/app/screens.h"

#include <QLabel>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/geometry/task_path.h"
#include "gui/scene/place_under.h"
#include "gui/scene/trial_texts.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/scene_look.h"

namespace reachlab::gui::app {
namespace {

constexpr int kMirrorMs = 250, kMirrorWidth = 220;  // no wider than a fifth of the scene: it hides what is behind it

}  // namespace

Screens::Screens(scene::SceneView& main) : main_(main), mirror_(new QLabel(&main)), mirrorTimer_(new QTimer(this)) {
  connect(&main, &scene::SceneView::handDragged, this, &Screens::handDragged);
  connect(&main, &scene::SceneView::placeDragged, this, &Screens::dragPlace);
  connect(&main, &scene::SceneView::placeDropped, this, [this](scene::TaskPlace place) {
    if (const auto q = std::exchange(dragged_, {})) Q_EMIT placeChosen(place, *q);
  });
  connect(&main, &scene::SceneView::placeLeft, this, &Screens::leavePlace);
  mirror_->setObjectName("subjectMirror");
  mirror_->setStyleSheet("border: 1px solid #6b7788; background: black;");
  mirror_->setAttribute(Qt::WA_TransparentForMouseEvents);
  mirror_->hide();
  mirrorTimer_->setInterval(kMirrorMs);
  connect(mirrorTimer_, &QTimer::timeout, this, &Screens::mirror);
  connect(&model_, &model::ModelReader::failed, this, &Screens::said);
  connect(&model_, &model::ModelReader::ready, this, [this] {
    if (!model_.model()) return;  // rebuilt by who asked for none
    rebuild(true);
  });
}

Screens::~Screens() { delete subject_; }

void Screens::showExperiment(const experiment::CompiledExperiment& experiment, const std::vector<Vec3>& blockPlaces) {
  const bool keepsView = !blockPlaces.empty() && blockPlaces == options_.blockPlaces;
  experiment_ = experiment;
  options_.blockPlaces = blockPlaces;
  model_.begin(model::findSceneFile(experiment::lookOf(experiment_->experiment()).sceneFile, folder_));
  rebuild(keepsView);
}

void Screens::rebuild(bool keepsView) {
  scene::ScenePlan plan = planScene(experiment_->experiment(), experiment_->constraint(), options_);
  plan.model = model_.model();
  frame_ = restingFrame(plan);
  main_.setPlan(plan, !keepsView);
  if (subject_) subject_->view().setPlan(subjectsPlan(plan, experiment_->experiment().subjectScreen), !keepsView);
  if (const experiment::SceneLook look = experiment::lookOf(experiment_->experiment()); !keepsView && !look.cameras.empty()) {
    for (scene::SceneView* view : {&main_, subject_ ? &subject_->view() : nullptr})
      if (view != nullptr) view->setCamera(look.cameras.front());
  }
  showPatch(nullptr);
}

void Screens::showRest() {
  frame_ = restingFrame(main_.plan());
  main_.showFrame(frame_);
  showSubjectsFrame(trial::Phase::Idle);
  showPatch(nullptr);
}

void Screens::showSubjectsFrame(trial::Phase phase) {
  if (!subject_) return;
  scene::SceneFrame seen = frame_;
  seen.cursorShown = isCursorShown(subject_->view().plan(), phase);
  subject_->view().showFrame(seen);
}

// White from the go signal to the trial's end: with the picture that shows it, not before.
void Screens::showPatch(const haptics::TickState* state) {
  if (!subject_) return;
  using Patch = subject::SubjectWindow::Patch;
  const bool white = state != nullptr && state->gone && (state->phase == trial::Phase::Armed || state->phase == trial::Phase::Moving);
  subject_->setPatch(!experiment_->experiment().subjectScreen.photodiode ? Patch::None : white ? Patch::White : Patch::Black);
}

void Screens::showState(const haptics::TickState& state, const network::OtherHands& others) {
  frame_.ownHand = main_.plan().ownHand;
  copyToFrame(state, frame_);
  frame_.hands.resize(std::max(frame_.hands.size(), main_.plan().hands.size()));
  for (std::size_t hand = 0; hand < std::min(others.known.size(), main_.plan().hands.size()); ++hand)
    if (others.known[hand]) frame_.hands[hand] = others.place[hand];
  if (!main_.plan().look.forceArrow) frame_.force = {};
  const auto& cursor = main_.plan().cursor;
  if (!cursor) cursor_ = {};  // a later kind of trial does not begin with the place of an earlier one
  else if (!frame_.masses.empty()) frame_.masses[0] = cursor_.at(state.tick, frame_.masses[0], cursor->delay);
  main_.showFrame(frame_);
  showSubjectsFrame(state.phase);
  showPatch(&state);
}

void Screens::showOverlay(const scene::OverlayState& experimenters, const scene::OverlayState& subjects) {
  overlay_ = experimenters;
  overlay_.legend = forcesText(main_.plan().forces);
  subjectsOverlay_ = subjects;
  main_.overlay().setState(overlay_);
  if (subject_) subject_->view().overlay().setState(subjects);
}

// The point of the constraint under the pointer, shown at once with its numbers. The drawn range stays as it was when the drag began.
void Screens::dragPlace(scene::TaskPlace place, const QPointF& pixel) {
  const experiment::Task& task = *experiment_->experiment().task;
  const constraints::Constraint& constraint = experiment_->constraint();
  const std::vector<double>& before = dragged_ ? *dragged_ : place == scene::TaskPlace::Start ? task.start : task.target;
  const auto q = scene::placeUnder({main_.camera(), pixel.x(), pixel.y(), double(main_.width()), double(main_.height())}, constraint,
                                   scene::drawnDomain(constraint, task.start, task.target), before);
  if (!q) return;
  dragged_ = q;
  const std::vector<std::string> names = constraint.kind == constraints::ConstraintKind::Free ? std::vector<std::string>{"x", "y", "z"}
                                                                                              : constraints::variablesOf(constraint.kind);
  QStringList words;
  for (std::size_t i = 0; i < q->size(); ++i)
    words << QStringLiteral("%1 = %2").arg(QString::fromStdString(names[i])).arg((*q)[i], 0, 'g', 5);
  main_.showPlace(place, placeOn(constraint, *q), words.join(", "));
}

void Screens::leavePlace(scene::TaskPlace place) {
  dragged_.reset();
  const experiment::Task& task = *experiment_->experiment().task;
  main_.showPlace(place, placeOn(experiment_->constraint(), place == scene::TaskPlace::Start ? task.start : task.target), {});
}

void Screens::setSideBySide(bool on) {
  options_.sideBySide = on ? scene::ViewOptions::SideBySide::Always : scene::ViewOptions::SideBySide::Never;
  const scene::Camera kept = main_.camera();
  rebuild();
  main_.setCamera(kept);
  main_.fit();
  Q_EMIT optionsChanged();
}

void Screens::setForcesShown(bool on) {
  options_.forces = on;
  scene::ScenePlan plan = main_.plan();
  plan.forces = on ? scene::markForces(experiment_->experiment(), plan.start, plan.target) : scene::ForceMarks();
  const scene::SceneFrame kept = main_.frame();
  main_.setPlan(plan, false);  // the subject's picture is left alone, also in mid-trial
  main_.showFrame(kept);
  Q_EMIT optionsChanged();
}

bool Screens::massesHide() const {
  const std::vector<Vec3>& shifts = main_.plan().massShift;
  return shifts.size() > 1 && std::all_of(shifts.begin(), shifts.end(), [](const Vec3& s) { return s == Vec3{}; });
}

void Screens::toggleSubject() {
  if (subject_) return closeSubject();
  openSubject({});
}

void Screens::showSubjectOn(const QString& screen) {
  if (subject_) subject_->showFull(screen);
  else openSubject(screen);
}

void Screens::openSubject(const QString& screen) {
  subject_ = new subject::SubjectWindow(main_);
  subject_->setAttribute(Qt::WA_DeleteOnClose);
  connect(&subject_->view(), &scene::SceneView::handDragged, this, &Screens::handDragged);
  subject_->view().setPlan(subjectsPlan(main_.plan(), experiment_->experiment().subjectScreen));
  subject_->view().overlay().setState(subjectsOverlay_);
  subject_->addActions(actions_);
  subject_->view().setFocus();  // Space begins a trial where the scene has the keys
  subject_->showFull(screen);
  showPatch(nullptr);
  mirrorTimer_->start();
}

void Screens::mirror() {
  mirror_->setVisible(subject_ && subject_->isVisible());
  if (!mirror_->isVisible()) {
    if (!subject_) mirrorTimer_->stop();
    return;
  }
  mirror_->setPixmap(subject_->grab().scaledToWidth(std::min(kMirrorWidth, main_.width() / 5), Qt::SmoothTransformation));
  mirror_->adjustSize();
  mirror_->move(main_.width() - mirror_->width() - 14, main_.height() - mirror_->height() - 64);
  mirror_->raise();
}

void Screens::closeSubject() {
  if (subject_) subject_->close();
}

}  // namespace reachlab::gui::app
