#include "sim/subjects/feedback_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/math/elementary.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"
#include "sim/subjects/plans/reach_plan.h"

namespace reachlab::subjects {
namespace {

constexpr int kTicksPerStep = static_cast<int>(kControlStep / kTickSeconds + 0.5);
constexpr double kAfterEnd = 0.3;                // [s] that gains go on after the last moment at which the trial can end
constexpr double kShortest = 0.2, kLongest = 3;  // of the task's duration: what may be drawn

/// A field along the way is felt as less damping of the arm.
ArmSpec inField(ArmSpec arm, const EnvironmentModel& believed) {
  arm.damping -= believed.along;
  return arm;
}

}  // namespace

std::shared_ptr<const FeedbackTask> makeFeedbackTask(const experiment::CompiledExperiment& compiled, const FeedbackSpec& spec) {
  const experiment::Experiment& experiment = compiled.experiment();
  const experiment::Task& task = *experiment.task;
  ReachWay way(compiled);
  CostSpec cost;
  cost.distance = way.length();
  cost.duration = task.duration;
  cost.hold = task.tolerance.time + kAfterEnd;
  cost.position = task.tolerance.position;
  cost.velocity = task.tolerance.velocity;
  cost.criterion = spec.criterion;
  cost.effort = spec.criterion ? spec.criterionEffort : spec.effort;
  predict::LineObject object = predict::makeLineObject(experiment, 0, 0);
  const bool bare = experiment.object.kind == experiment::ObjectKind::None;
  if (spec.criterion) {
    const double mass = spec.arm.mass + object.totalMass();
    static_cast<void>(criterionRow(makeArmWorld(spec.arm, object), spec.arm, mass, *spec.criterion));
    // The least that this criterion can cost here, on a line of the same length: the scale of its weight.
    predict::PredictOptions options;
    options.handMass = spec.arm.mass;
    const LineExperiment line = onLine(experiment, way.length());
    cost.criterionWeight =
        spec.criterionWeight / (line.scale * line.scale * predict::predict(line.experiment, *spec.criterion, options)->cost);
    if (*spec.criterion == predict::Criterion::MinComAcceleration) cost.criterionWeight /= mass * mass;
  }
  return std::make_shared<const FeedbackTask>(
      FeedbackTask{.way = std::move(way),
                   .object = std::move(object),
                   .cost = cost,
                   .normal = experiment::normalOf(task.plane),
                   .bare = bare,
                   .pushed = bare || !experiment.environment.empty(),
                   .cursor = experiment.cursor && experiment.cursor->show != experiment::CursorShow::Never});
}

FeedbackHand::FeedbackHand(std::shared_ptr<const FeedbackTask> task, std::shared_ptr<SubjectState> state, std::uint64_t seed)
    : task_(std::move(task)), state_(std::move(state)), seed_(seed), arm_(stepArm(state_->person.arm, kTickSeconds)),
      sight_(static_cast<std::size_t>(task_->object.count()) + 1) {
  prepareFirst();
  const FeedbackGains& g = playing_.gains;
  const auto sized = [](int a, int b = 1) { return static_cast<std::size_t>(a) * static_cast<std::size_t>(b); };
  const int most = static_cast<int>((kLongest * task_->cost.duration + task_->cost.hold) / kControlStep) + 2;
  trace_.command.resize(sized(most));
  trace_.sensed.resize(sized(most, g.senses()));
  errorsAtStep_.resize(sized(most));
  estimate_.resize(sized(g.estimate()));
  next_.resize(estimate_.size());
  error_.resize(sized(g.senses()));
  sensed_.resize(error_.size());
  touched_.resize(sized(g.touch, g.touchDelay + 1));
  seen_.resize(sized(g.sight, g.sightDelay + 1));
  placeAtStart();
}

void FeedbackHand::learnFromTrace() {
  const FeedbackSpec& person = state_->person;
  trace_.steps = traceSteps_.load(std::memory_order_acquire);
  if (trace_.steps == 0) return;
  if (person.learning.learnFast > 0 || person.learning.learnSlow > 0) {
    const ModelError step = computeModelStep(playing_.gains, trace_, playing_.used, inField(person.arm, playing_.believed), task_->object,
                                             person.senses, task_->cost.distance);
    learn(person.learning, step, state_->model);
  }
  learn(person.environment, errorsAtStep_[static_cast<std::size_t>(trace_.steps - 1)].error(), state_->environment);
  ++state_->model.trials;
  traceSteps_.store(0, std::memory_order_relaxed);
}

void FeedbackHand::prepareTrial(int index, int /*scene*/) {
  learnFromTrace();
  if (takeFirst(index)) return;
  const FeedbackSpec& person = state_->person;
  SubjectDraws draws(seed_, static_cast<std::uint64_t>(index));
  const double sigma = person.noise * person.noiseScale *
                       (1 + person.practice * elementary::exp(-static_cast<double>(state_->model.trials) / person.practiceTrials));
  const ModelError mean = state_->model.current();
  FeedbackReach& reach = prepared_;
  reach.used.stiffness = mean.stiffness + sigma * person.planSd.stiffness * draws.boundedNormal();
  reach.used.mass = mean.mass + sigma * person.planSd.mass * draws.boundedNormal();
  CostSpec cost = task_->cost;
  cost.duration *= std::clamp(1 + person.noise * person.timeSd * draws.boundedNormal(), kShortest, kLongest);
  reach.reactionTicks = static_cast<int>(std::lround(draws.reaction(person.reaction, person.noise) / kTickSeconds));
  reach.believed = state_->environment.current();
  const ArmSpec arm = inField(person.arm, reach.believed);
  reach.gains =
      computeFeedbackGains(makeArmWorld(arm, task_->object, reach.used), arm, cost, person.senses, person.motorNoise, person.forceNoise);
  reach.draws.resize(static_cast<std::size_t>(reach.gains.steps) * static_cast<std::size_t>(reach.gains.senses() + 2));
  for (double& draw : reach.draws) draw = person.noise == 0 ? 0 : person.noise * draws.normal();
  reach.ready = true;
}

void FeedbackHand::placeAtStart() noexcept {
  body_ = {-task_->cost.distance, 0, 0, 0};
  aside_ = asideSpeed_ = felt_ = {};
  push_ = command_ = noisy_ = against_ = 0;
  errors_ = {};
  aim_ = task_->cursor ? experiment::rotationInPlane(-playing_.believed.angle) : experiment::PlaneRotation{};
  going_ = false;
  ticks_ = steps_ = 0;
  traceSteps_.store(0, std::memory_order_relaxed);
  const double start = -task_->cost.distance;
  const FeedbackGains& g = playing_.gains;
  std::fill(sight_.begin(), sight_.end(), start);
  std::fill(seen_.begin(), seen_.end(), start);
  for (std::size_t i = 0; i < touched_.size(); ++i) touched_[i] = i % 3 == 0 ? start : 0;
  // The start is exactly known: every place is there, and so it was felt and seen.
  for (int i = 0; i < g.estimate(); ++i) {
    const bool place = i < g.states ? i == 0 || (i >= 4 && i < 4 + (g.states - 4) / 2)
                                    : i >= g.states + g.touch * g.touchDelay || (i - g.states) % g.touch == 0;
    estimate_[static_cast<std::size_t>(i)] = place ? start : 0;
  }
}

Vec3 FeedbackHand::aimed(const Vec3& v) const noexcept { return task_->cursor ? experiment::rotated(v, task_->normal, aim_) : v; }

// One step of estimator and controller; the model's own time runs from the end of the reaction.
void FeedbackHand::step() noexcept {
  const FeedbackGains& g = playing_.gains;
  const FeedbackSpec& person = state_->person;
  const int n = g.states, p = g.touch, v = g.sight, all = g.estimate(), ny = g.senses();
  const int at = std::min(steps_, g.steps - 1);
  const std::span draw{playing_.draws.data() + static_cast<std::ptrdiff_t>(at) * (ny + 2), static_cast<std::size_t>(ny + 2)};
  const Vec3 along = aimed(task_->way.at(body_[0] + task_->cost.distance).along);
  const double ofObject = task_->bare ? 0 : -dot(felt_, along);  // against the hand

  // What is sensed now comes later.
  const int touchPlace = steps_ % (g.touchDelay + 1), sightPlace = v > 0 ? steps_ % (g.sightDelay + 1) : 0;
  const SenseSpec& s = person.senses;
  double* touched = touched_.data() + touchPlace * p;
  touched[0] = body_[0], touched[1] = body_[1], touched[2] = ofObject;
  for (int j = 0; j < v; ++j) {
    const int state = g.seen[static_cast<std::size_t>(j)];
    seen_[static_cast<std::size_t>(sightPlace * v + j)] = state == 0 ? body_[0] : sight_[static_cast<std::size_t>(state - 3)];
  }
  const double* oldTouch = touched_.data() + (steps_ + 1) % (g.touchDelay + 1) * p;
  const double* oldSight = v > 0 ? seen_.data() + (steps_ + 1) % (g.sightDelay + 1) * v : nullptr;
  double* z = estimate_.data();
  const int touchAt = n, sightAt = n + p * g.touchDelay;
  const double sd[] = {s.position, s.velocity, s.force};
  double* y = sensed_.data();
  for (int j = 0; j < p; ++j) y[j] = oldTouch[j] + sd[j] * draw[j];
  for (int j = 0; j < v; ++j) y[p + j] = oldSight[j] + s.seen * draw[p + j];
  for (int j = 0; j < p; ++j) error_[static_cast<std::size_t>(j)] = y[j] - z[sightAt - p + j];
  for (int j = 0; j < v; ++j) error_[static_cast<std::size_t>(p + j)] = y[p + j] - z[all - v + j];

  command_ = 0;
  const double* control = g.control.data() + static_cast<std::ptrdiff_t>(at) * n;
  for (int k = 0; k < n; ++k) command_ -= control[k] * z[k];

  double* next = next_.data();
  for (int k = 0; k < n; ++k) next[k] = g.command[static_cast<std::size_t>(k)] * command_;
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < n; ++k) next[k] += g.advance[static_cast<std::size_t>(j * n + k)] * z[j];
  for (int j = 0; j < p; ++j) {
    double value = 0;
    for (int k = 0; k < n; ++k) value += g.felt[static_cast<std::size_t>(j * n + k)] * z[k];
    next[touchAt + j] = value;
  }
  std::copy(z + touchAt, z + touchAt + p * (g.touchDelay - 1), next + touchAt + p);
  for (int j = 0; j < v; ++j) next[sightAt + j] = z[g.seen[static_cast<std::size_t>(j)]];
  if (v > 0) std::copy(z + sightAt, z + sightAt + v * (g.sightDelay - 1), next + sightAt + v);
  const double* filter = g.filter.data() + static_cast<std::ptrdiff_t>(at) * all * ny;
  for (int c = 0; c < ny; ++c)
    for (int k = 0; k < all; ++k) next[k] += filter[c * all + k] * error_[static_cast<std::size_t>(c)];
  const double speed = z[1];  // as it is believed to be now
  std::swap(estimate_, next_);
  if (isPushed()) {
    const double unexplained = task_->bare ? dot(felt_, along) - playing_.believed.along * body_[1] : 0;
    errors_.add(unexplained, dot(felt_, experiment::rightOf(along, task_->normal)) + against_, body_[1]);
    against_ = -playing_.believed.across * speed;
  }

  noisy_ = command_ * (1 + person.motorNoise * draw[ny]) + person.forceNoise * draw[ny + 1];
  if (steps_ < g.steps) {
    trace_.command[static_cast<std::size_t>(at)] = command_;
    std::copy(y, y + ny, trace_.sensed.data() + static_cast<std::ptrdiff_t>(at) * ny);
    errorsAtStep_[static_cast<std::size_t>(at)] = errors_;
    traceSteps_.store(steps_ + 1, std::memory_order_release);
  }
  ++steps_;
}

// A person who has learned a field still pushes against it where it is gone, and unlearns it there.
bool FeedbackHand::isPushed() const noexcept { return task_->pushed || playing_.believed.along != 0 || playing_.believed.across != 0; }

haptics::DeviceSample FeedbackHand::read() noexcept {
  const double start = -task_->cost.distance;
  if (going_) {
    if (ticks_ >= playing_.reactionTicks) {
      if ((ticks_ - playing_.reactionTicks) % kTicksPerStep == 0) step();
      const Vec3 direction = aimed(task_->way.at(body_[0] - start).along);
      const double along = dot(felt_, direction) + push_;
      std::array<double, 4> moved{};
      for (int i = 0; i < 4; ++i) {
        double value = arm_.command(i) * noisy_ + arm_.force(i) * along;
        for (int j = 0; j < 4; ++j) value += arm_.a(i, j) * body_[static_cast<std::size_t>(j)];
        moved[static_cast<std::size_t>(i)] = value;
      }
      body_ = moved;
      // Across the way the arm is a spring, critically damped.
      const double mass = state_->person.arm.mass, stiffness = task_->onTheWayStiffness, damping = 2 * std::sqrt(stiffness * mass);
      Vec3 across = felt_ - dot(felt_, direction) * direction;
      if (isPushed()) across += against_ * experiment::rightOf(direction, task_->normal);
      asideSpeed_ += kTickSeconds / mass * (across - stiffness * aside_ - damping * asideSpeed_);
      aside_ += kTickSeconds * asideSpeed_;
    }
    ++ticks_;
  }
  const ReachWay::Place place = task_->way.at(body_[0] - start);
  const Vec3 first = task_->way.at(0).position;
  return {.position = (task_->cursor ? first + aimed(place.position - first) : place.position) + aside_,
          .velocity = body_[1] * aimed(place.along) + asideSpeed_,
          .hasVelocity = true};
}

// Looked at where the next tick is a control step.
void FeedbackHand::see(std::span<const dynamics::MassState> masses) noexcept {
  if (ticks_ < playing_.reactionTicks || (ticks_ - playing_.reactionTicks) % kTicksPerStep != 0) return;
  if (task_->cursor && !masses.empty()) {
    const ReachWay::Place start = task_->way.at(0);
    const Vec3 moved = masses[0].r - start.position, right = experiment::rightOf(start.along, task_->normal);
    errors_.look(elementary::atan2(-dot(moved, right), dot(moved, start.along)) * 180 / std::numbers::pi, body_[1]);
  }
  const std::size_t count = std::min(masses.size(), sight_.size() - 1);
  for (std::size_t i = 0; i < count; ++i) sight_[i + 1] = task_->way.placeOf(masses[i]) - task_->cost.distance;
}

}  // namespace reachlab::subjects
