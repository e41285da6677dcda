#include "sim/haptics/tick_engine.h"

#include <algorithm>

#include "base/fault.h"
#include "base/minimum_jerk.h"
#include "base/ticks.h"
#include "sim/dynamics/compiled_scene.h"
#include "sim/experiment/checked_experiment.h"

namespace reachlab::haptics {
namespace {

constexpr double kJump = 0.02;  // [m] in one tick: 20 m/s, no hand does that; the device has jumped

// 1 at x = 0, 0 at x = 1, at rest at both ends (1 minus the minimum-jerk law), and its derivative.
struct Blend {
  double value, rate;
};
Blend fadeOut(double x) noexcept { return {1 - minimumJerk(x), -minimumJerkRate(x)}; }

ForceLimits limitsFor(const experiment::Experiment& experiment, const EngineOptions& options) {
  double most = experiment.forceLimit.value_or(options.deviceMaxForce);
  if (options.rendersForce) most = std::min(most, options.deviceMaxForce);
  return {most, options.rendersForce ? options.continuousForce : 0, options.thermalSeconds};
}

}  // namespace

EngineOptions engineOptions(const DeviceInfo& device) {
  return {device.maxForce, device.virtualHand, device.rendersForce, device.maxContinuousForce, device.thermalSeconds, device.guards};
}

TickEngine::TickEngine(const experiment::Experiment& experiment, const EngineOptions& options)
    : TickEngine(experiment, (experiment::requiredTask(experiment), dynamics::compileScene(experiment)), options) {}

TickEngine::TickEngine(const experiment::CompiledExperiment& experiment, const EngineOptions& options)
    : TickEngine(experiment.experiment(), (experiment::requiredTask(experiment.experiment()), dynamics::compileScene(experiment)),
                 options) {}

TickEngine::TickEngine(const experiment::Experiment& experiment, dynamics::Scene scene, const EngineOptions& options)
    : scene_(std::move(scene)), ends_(dynamic_cast<const dynamics::EndMasses*>(scene_.plant.get())),
      start_(experiment::requiredTask(experiment).start), settings_(trial::makeProtocolSettings(experiment, scene_.constraint)),
      virtualHand_(options.virtualHand), estimator_(experiment.velocityEstimator), path_(4, kJump), safety_(limitsFor(experiment, options)),
      guards_(options.guards), fpInBody_(experiment.object.kind == experiment::ObjectKind::Body ? experiment.object.fpOffset : Vec3{}) {
  state_.massCount = scene_.plant->massCount();
  state_.rendersForce = options.rendersForce;
  if (virtualHand_) settings_.startTimeoutTicks = settings_.timeoutTicks + settings_.restTicks;
  lastSeen_ = settings_.start;
  putUp();
}

void TickEngine::putUp() noexcept {
  dynamics::Plant& plant = *scene_.plant;
  plant.placeAtRest(start_);
  plant.observe({settings_.start, {}, true}, state_.masses);
  for (int i = 0; i < state_.massCount; ++i) state_.masses[i].a = {};
  state_.body = plant.body();
  fpOffset_ = anchor_ = {};
  anchorTicks_ = 0;
  handBroken_ = clamped_ = false;
  forceStatus_ = dynamics::StepStatus::Ok;
  safety_.rearm();
  port_.reset();
}

dynamics::HandSample TickEngine::takeHand(const TickInput& input) noexcept {
  const DeviceSample& device = input.device;
  const bool finite = isFinite(device.position) && (!device.hasVelocity || isFinite(device.velocity));
  if (!finite) handBroken_ = true;
  if (!device.valid || handBroken_) {
    handLost_ = true;
    return {lastSeen_, {}, false};
  }
  const bool anew = handLost_ || (input.missedTicks > kGapTicks && !virtualHand_);
  if (anew || norm(device.position - lastRaw_) > kJump) estimator_.reset();
  lastRaw_ = device.position;
  dynamics::HandSample hand{device.position - fpOffset_, estimator_.estimate(device), true};
  if (anew && trial::isEngaged(protocol_.phase)) {
    anchor_ = lastSeen_ - hand.position;
    anchorTicks_ = kReanchorTicks;
  }
  handLost_ = false;
  if (anchorTicks_ > 0) {
    const Blend blend = fadeOut(1 - static_cast<double>(anchorTicks_) / kReanchorTicks);
    hand.position += blend.value * anchor_;
    hand.velocity += (blend.rate / (kReanchorTicks * kTickSeconds)) * anchor_;
    --anchorTicks_;
  }
  lastSeen_ = hand.position;
  return hand;
}

dynamics::StepStatus TickEngine::stepObject(const dynamics::HandSample& hand) noexcept {
  const bool continuous = path_.push(hand);
  if (!hand.valid) return dynamics::StepStatus::HandLost;
  if (!continuous) scene_.plant->restart();
  return scene_.plant->step(path_.segment(), kTickSeconds);
}

void TickEngine::observeMasses(const dynamics::HandSample& hand) noexcept {
  const std::span<const dynamics::MassState> masses{state_.masses.data(), static_cast<std::size_t>(state_.massCount)};
  const bool endsSuffice = ends_ != nullptr && state_.tick % massesEvery_ != 0 && ends_->observeEnds(state_.masses) &&
                           !trial::needsEveryMass(settings_, protocol_, state_.tick, masses);
  sawAll_ = !endsSuffice;
  if (sawAll_) scene_.plant->observe(hand, state_.masses);
}

// At arming the FP is placed on the HIP: the hand is seen where the FP is, in mass 1 or fixed to the body, which still is as it was put up.
void TickEngine::placeFixedPoint(dynamics::HandSample& hand) noexcept {
  const Vec3 fixedPoint = state_.masses[0].r + fpInBody_;
  fpOffset_ = hand.position - fixedPoint;
  hand.position = lastSeen_ = fixedPoint;
  path_.reset();
  path_.push(hand);
  scene_.plant->restart();
}

void TickEngine::tick(const TickInput& input) noexcept {
  dynamics::Plant& plant = *scene_.plant;
  ++state_.tick;
  state_.measuredNs = input.measuredNs;
  state_.device = input.device;
  state_.faults.missedTicks += input.missedTicks;
  cue_.reset();
  sawAll_ = true;

  const trial::Phase before = protocol_.phase;
  if (input.command == trial::Command::NextTrial && (before == trial::Phase::Idle || before == trial::Phase::Done)) {
    putUp();
    cue_ = Cue::Place;
  }
  dynamics::HandSample hand = takeHand(input);
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  if (trial::isEngaged(before)) {
    status = stepObject(hand);
    observeMasses(hand);
    if (status == dynamics::StepStatus::Ok) status = forceStatus_;
  }

  const bool wasGone = protocol_.gone;
  trial::advance(settings_,
                 {state_.tick,
                  input.command,
                  input.planned,
                  input.device.position,
                  norm(hand.velocity),
                  hand.valid,
                  handBroken_,
                  clamped_,
                  status,
                  {state_.masses.data(), static_cast<std::size_t>(state_.massCount)},
                  input.missedTicks},
                 protocol_);
  if (!sawAll_ && !trial::isEngaged(protocol_.phase)) {  // as it ended, so it is shown and recorded from now on
    plant.observe(hand, state_.masses);
    sawAll_ = true;
  }
  if (before == trial::Phase::Waiting && protocol_.phase == trial::Phase::Armed) {
    placeFixedPoint(hand);
    plant.observe(hand, state_.masses);
  }
  if (protocol_.gone && (!wasGone || before == trial::Phase::Waiting)) cue_ = Cue::Go;

  exertForce(hand, status, input.missedTicks);
  state_.deviceState = deviceState(input);
  state_.hand = hand;
  state_.phase = protocol_.phase;
  state_.semaphore = protocol_.semaphore;
  state_.gone = protocol_.gone;
  state_.trial = protocol_.trial;
  state_.trialTime = protocol_.phase == trial::Phase::Moving ? static_cast<double>(state_.tick - protocol_.onsetTick) * kTickSeconds
                                                             : protocol_.result.movementTime;
  state_.result = protocol_.result;
}

// What acts beside the object: the workspace's wall, and the passivity controller where it is wanted.
Vec3 TickEngine::guardForce(const dynamics::HandSample& hand, bool engaged) noexcept {
  state_.interventions = 0;
  if (hand.valid) port_.observe(state_.device.position);
  state_.portEnergy = port_.energy();
  if (!engaged) return {};
  const Vec3 wall = wallForce(guards_, state_.device.position, hand.velocity);
  if (!(wall == Vec3{})) state_.interventions |= intervention::kWall;
  const Vec3 dissipation = guards_.passivityControl ? port_.control(hand.velocity) : Vec3{};
  if (!(dissipation == Vec3{})) state_.interventions |= intervention::kPassivity;
  return wall + dissipation;
}

DeviceState TickEngine::deviceState(const TickInput& input) const noexcept {
  if (input.deviceFault || safety_.latched()) return DeviceState::Fault;
  if (!input.device.valid && !input.device.released) return DeviceState::Off;
  if (trial::isEngaged(protocol_.phase)) return DeviceState::Engaged;
  return protocol_.phase == trial::Phase::Waiting ? DeviceState::Armed : DeviceState::Homed;
}

void TickEngine::exertForce(const dynamics::HandSample& hand, dynamics::StepStatus status, std::uint32_t missedTicks) noexcept {
  const dynamics::Plant& plant = *scene_.plant;
  const bool engaged = trial::isEngaged(protocol_.phase);
  const bool held = hand.valid && status == dynamics::StepStatus::Ok;
  state_.couplingForce = engaged && held ? plant.couplingForce(hand) : Vec3{};
  if (!engaged || !held) state_.energy = 0;
  else if (sawAll_) state_.energy = plant.energy(hand);
  if (!isFinite(state_.couplingForce)) forceStatus_ = status = dynamics::StepStatus::NotFinite;
  state_.feedbackForce = -state_.couplingForce;
  const Vec3 added = guardForce(hand, engaged && held);
  const bool weighs = !(guards_.compensation == Vec3{});
  Vec3 asked = state_.feedbackForce;
  if (!(added == Vec3{})) asked += added;
  if (weighs) asked += guards_.compensation;
  state_.deviceForce = safety_.limit(asked, engaged || weighs, held && missedTicks <= kGapTicks);
  port_.render(weighs && !(state_.deviceForce == Vec3{}) ? state_.deviceForce - guards_.compensation : state_.deviceForce);
  state_.clamped = !(state_.deviceForce == asked);
  state_.interventions |= safety_.interventions();
  clamped_ = norm(state_.feedbackForce) > safety_.limit();
  if (engaged && state_.clamped) ++state_.faults.clampedTicks;
  if (engaged) {
    ++state_.faults.steps[static_cast<std::size_t>(status)];
    state_.body = plant.body();
  }
  state_.status = status;
}

}  // namespace reachlab::haptics
