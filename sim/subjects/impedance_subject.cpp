#include "sim/subjects/impedance_subject.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/fault.h"
#include "base/math/elementary.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "sim/dynamics/hand/hand_path.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/blind_hand.h"
#include "sim/subjects/plans/sampled_plan.h"
#include "sim/subjects/plans/subject_draws.h"
#include "sim/subjects/prepared_hand.h"
#include "sim/subjects/subject_parameters.h"
#include "sim/trial/protocol.h"

namespace reachlab::subjects {
namespace {

constexpr int kDrawTicks = 10;  // a draw of the muscle's noise lasts as long as a control step of kind=ofc

/// A reach as it is meant, tick by tick: place, velocity, and the muscle's force that arm and known object need for it.
struct MeantReach {
  std::vector<Vec3> place, velocity, force;  // [m], [m/s], [N]
};

/// The object as the subject knows it.
experiment::Experiment knownTo(const ImpedanceSpec& spec, experiment::Experiment experiment) {
  for (double& k : experiment.object.stiffness) k *= elementary::exp(spec.model.stiffness);
  if (experiment.coupling) experiment.coupling->stiffness *= elementary::exp(spec.model.stiffness);
  for (double& m : experiment.object.masses) m *= elementary::exp(spec.model.mass);
  return experiment;
}

/// What all subjects share.
struct ImpedanceTask {
  ImpedanceSpec spec;
  SampledPlan plan;
  experiment::Experiment known;
  constraints::Constraint constraint;
};

/// Inverse dynamics of the object by its own scene: the plan is led through it, and what the hand must give is kept.
MeantReach meanReach(const ImpedanceTask& task, dynamics::Plant& object, double stretch) {
  const ArmSpec& arm = task.spec.arm;
  const double duration = task.plan.duration() * stretch;
  const auto steps = static_cast<std::size_t>(std::ceil(duration / kTickSeconds));
  MeantReach reach;
  for (std::size_t i = 0; i <= steps + 1; ++i)
    reach.place.push_back(task.plan.at(std::min(static_cast<double>(i) * kTickSeconds / stretch, task.plan.duration())));
  const std::size_t count = reach.place.size();
  const auto at = [&](std::size_t i, std::ptrdiff_t by) {
    return reach.place[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(i) + by, 0, static_cast<std::ptrdiff_t>(count) - 1))];
  };
  for (std::size_t i = 0; i < count; ++i) reach.velocity.push_back((at(i, 1) - at(i, -1)) / (2 * kTickSeconds));
  object.placeAtRest(task.known.task->start);
  dynamics::HandPath path;
  path.push({reach.place[0], {}, true});
  for (std::size_t i = 0; i < count; ++i) {
    const dynamics::HandSample hand{reach.place[i], reach.velocity[i], true};
    Vec3 held;
    if (i > 0) path.push(hand);
    if (i == 0 || object.step(path.segment(), kTickSeconds) == dynamics::StepStatus::Ok) held = object.couplingForce(hand);
    const Vec3 acceleration = (at(i, 1) - 2 * reach.place[i] + at(i, -1)) / (kTickSeconds * kTickSeconds);
    reach.force.push_back(arm.mass * acceleration + arm.damping * reach.velocity[i] + held);
  }
  return reach;
}

struct ImpedanceReach {
  MeantReach reach;
  std::vector<double> draws;
  int reactionTicks = 0;
  bool ready = false;
};

class ImpedanceHand final : public PreparedHand<ImpedanceReach>, public haptics::BlindHand {
 public:
  ImpedanceHand(std::shared_ptr<const ImpedanceTask> task, std::uint64_t seed)
      : task_(std::move(task)), known_(dynamics::compileScene(task_->known, task_->constraint)), seed_(seed),
        arm_(stepArm(task_->spec.arm, kTickSeconds)), delayTicks_(static_cast<std::size_t>(std::lround(task_->spec.delay / kTickSeconds))),
        before_(delayTicks_ + 1) {
    prepareFirst();
    placeAtStart();
  }

  void prepareTrial(int index, int /*scene*/ = 0) override {
    if (takeFirst(index)) return;
    const ImpedanceSpec& spec = task_->spec;
    SubjectDraws draws(seed_, static_cast<std::uint64_t>(index));
    constexpr double kLeastStretch = 0.2;
    const double stretch = std::max(kLeastStretch, 1 + spec.noise * spec.timeSd * draws.boundedNormal());
    const double reaction = draws.reaction(spec.reaction, spec.noise);
    prepared_.reach = meanReach(*task_, *known_.plant, stretch);
    prepared_.reactionTicks = static_cast<int>(std::lround(reaction / kTickSeconds));
    prepared_.draws.resize(6 * (prepared_.reach.place.size() / kDrawTicks + 1));
    for (double& draw : prepared_.draws) draw = spec.noise * draws.normal();
    prepared_.ready = true;
  }

  haptics::DeviceSample read() noexcept override {
    if (going_ && ticks_++ >= playing_.reactionTicks) advance(static_cast<std::size_t>(ticks_ - 1 - playing_.reactionTicks));
    return {.position = place_, .velocity = velocity_, .hasVelocity = true};
  }

 private:
  struct Kept {
    Vec3 off, offSpeed;  // [m], [m/s] meant less true
  };

  void placeAtStart() noexcept override {
    place_ = playing_.reach.place[0];
    velocity_ = correction_ = stage_ = noiseForce_ = noiseStage_ = felt_ = {};
    going_ = false;
    ticks_ = 0;
    std::fill(before_.begin(), before_.end(), Kept{});
  }

  // The arm over one tick; the force that the plan needs arrives on time, corrections and noise pass the muscle's two stages.
  void advance(std::size_t tick) noexcept {
    const ImpedanceSpec& spec = task_->spec;
    const MeantReach& reach = playing_.reach;
    const std::size_t last = reach.place.size() - 1, at = std::min(tick, last), next = std::min(tick + 1, last);
    const Vec3 off = reach.place[at] - place_, offSpeed = (at < last ? reach.velocity[at] : Vec3{}) - velocity_;
    Kept& place = before_[tick % before_.size()];
    place = {off, offSpeed};
    const Kept& old = before_[(tick + 1) % before_.size()];
    const Vec3 planned = 0.5 * (reach.force[at] + reach.force[next]);
    const Vec3 wanted = spec.feedbackStiffness * old.off + spec.feedbackDamping * old.offSpeed;
    const std::size_t draw = 6 * std::min(tick / kDrawTicks, playing_.draws.size() / 6 - 1);
    const auto drawn = [&](std::size_t k) {
      return Vec3{playing_.draws[draw + k], playing_.draws[draw + k + 1], playing_.draws[draw + k + 2]};
    };
    const Vec3 a = drawn(0), b = drawn(3);
    // Noise is drawn for each axis: in proportion to that axis' command.
    const Vec3 noisy{spec.motorNoise * planned.x * a.x, spec.motorNoise * planned.y * a.y, spec.motorNoise * planned.z * a.z};
    const double size = norm(planned);
    const Vec3 additive = size > 0 ? spec.forceNoise * b.x / size * planned : Vec3{};
    const double keep = elementary::exp(-kTickSeconds / spec.arm.muscle);
    const auto throughMuscle = [&](const Vec3& command, Vec3& stage, Vec3& force) {
      stage = keep * stage + (1 - keep) * command;
      force = keep * force + (1 - keep) * stage;
    };
    throughMuscle(wanted, stage_, correction_);
    throughMuscle(noisy + additive, noiseStage_, noiseForce_);
    // [h, h'] with every force held over the tick, the impedance's part at the middle of the step.
    const auto step = [&](double h, double v, double f) {
      return std::pair{h + arm_.a(0, 1) * v + arm_.force(0) * f, arm_.a(1, 1) * v + arm_.force(1) * f};
    };
    const Vec3 held = spec.stiffness * off + spec.damping * offSpeed;
    const Vec3 force = planned + correction_ + noiseForce_ + felt_ + held;
    const auto [x, vx] = step(place_.x, velocity_.x, force.x);
    const auto [y, vy] = step(place_.y, velocity_.y, force.y);
    const auto [z, vz] = step(place_.z, velocity_.z, force.z);
    place_ = {x, y, z};
    velocity_ = {vx, vy, vz};
  }

  std::shared_ptr<const ImpedanceTask> task_;
  dynamics::Scene known_;  // the controlling thread's
  std::uint64_t seed_;
  SteppedArm arm_;
  std::size_t delayTicks_;
  Vec3 place_, velocity_, correction_, stage_, noiseForce_, noiseStage_;
  std::vector<Kept> before_;
  int ticks_ = 0;
};

}  // namespace

ImpedanceSpec parseImpedanceSubject(const std::string& text) {
  SubjectOptions options(text, impedanceParameters());
  static_cast<void>(options.word("kind", {"impedance"}));
  const auto number = [&](std::string_view key) { return options.number(key); };
  ImpedanceSpec spec;
  if (const auto criterion = options.take("criterion")) {
    spec.criterion = predict::criterionFromName(*criterion);
    if (!spec.criterion) throw FaultError(Fault{"device", "simulated: criterion=" + *criterion, "a name from `reach list criteria`"});
  }
  spec.arm = {number("arm-mass"), number("arm-damping"), number("muscle")};
  spec.stiffness = number("stiffness");
  spec.damping = number("damping");
  spec.feedbackStiffness = number("feedback-stiffness");
  spec.feedbackDamping = number("feedback-damping");
  spec.delay = number("delay");
  spec.motorNoise = number("motor-noise");
  spec.forceNoise = number("force-noise");
  spec.model = {number("model-stiffness"), number("model-mass")};
  constexpr double kNotGiven = -1;
  if (const double mass = options.number("hand-mass", kNotGiven); mass != kNotGiven) spec.handMass = mass;
  else if (spec.criterion) spec.handMass = spec.arm.mass;
  spec.timeSd = number("time-sd");
  spec.reaction = number("reaction");
  spec.noise = number("noise");
  options.done();
  return spec;
}

MakeSubject prepareImpedanceSubjects(const experiment::CompiledExperiment& experiment, const ImpedanceSpec& spec) {
  const auto task =
      std::make_shared<const ImpedanceTask>(ImpedanceTask{spec, SampledPlan(makeReachPlan(experiment, spec.criterion, spec.handMass)),
                                                          knownTo(spec, experiment.experiment()), experiment.constraint()});
  return [task](std::uint64_t seed, int, std::shared_ptr<void>&) { return std::make_unique<ImpedanceHand>(task, seed); };
}

}  // namespace reachlab::subjects
