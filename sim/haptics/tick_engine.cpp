#include "sim/haptics/tick_engine.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/fault.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "sim/dynamics/compiled_scene.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"

namespace reachlab::haptics {
namespace {

// 1 at x = 0, 0 at x = 1, at rest at both ends (1 minus the minimum-jerk law), and its derivative.
struct Blend {
  double value, rate;
};
Blend fadeOut(double x) noexcept { return {1 - minimumJerk(x), -minimumJerkRate(x)}; }

// What stands of the device must fit the experiment's hands.
void requireHands(const experiment::Experiment& experiment, const EngineOptions& options) {
  const std::size_t hands = std::max<std::size_t>(experiment.hands.size(), 1), devices = options.others.size() + 1;
  if (hands != devices)
    throw FaultError(Fault{
        "device",
        fmt::format("is {} device{} where the experiment has {} hand{}", devices, devices == 1 ? "" : "s", hands, hands == 1 ? "" : "s"),
        "a device for each of the experiment's hands"});
}

ForceLimits limitsFor(const experiment::Experiment& experiment, const EngineOptions& options) {
  double most = experiment.forceLimit.value_or(options.deviceMaxForce);
  if (options.rendersForce) most = std::min(most, options.deviceMaxForce);
  return {most, options.rendersForce ? options.continuousForce : 0, options.thermalSeconds};
}

}  // namespace

EngineOptions engineOptions(const DeviceInfo& device) {
  return {device.maxForce, device.virtualHand, device.rendersForce, device.maxContinuousForce, device.thermalSeconds, device.guards, {}};
}

EngineOptions engineOptions(const HapticDevice& device) {
  EngineOptions options = engineOptions(device.info());
  for (const HapticDevice* other : device.otherHands()) options.others.push_back(engineOptions(other->info()));
  return options;
}

TickEngine::TickEngine(const experiment::Experiment& experiment, const EngineOptions& options)
    : TickEngine(experiment, (experiment::requiredTask(experiment), dynamics::compileScene(experiment)), options) {}

TickEngine::TickEngine(const experiment::CompiledExperiment& experiment, const EngineOptions& options)
    : TickEngine(experiment.experiment(), (experiment::requiredTask(experiment.experiment()), dynamics::compileScene(experiment)),
                 options) {}

TickEngine::Port::Port(const experiment::Experiment& experiment, const EngineOptions& options)
    : virtualHand(options.virtualHand), estimator(experiment.velocityEstimator), path(4), safety(limitsFor(experiment, options)),
      guards(options.guards), fpInBody(experiment.object.kind == experiment::ObjectKind::Body ? experiment.object.fpOffset : Vec3{}) {}

TickEngine::TickEngine(const experiment::Experiment& experiment, dynamics::Scene scene, const EngineOptions& options)
    : scene_(std::move(scene)), ends_(dynamic_cast<const dynamics::EndMasses*>(scene_.plant.get())),
      needsVelocity_(scene_.plant->needsHandVelocity()), start_(experiment::requiredTask(experiment).start),
      settings_(trial::makeProtocolSettings(experiment, scene_.constraint)), port_(experiment, options) {
  if (scene_.shared != nullptr || !options.others.empty()) requireHands(experiment, options);
  for (const EngineOptions& other : options.others) others_.emplace_back(experiment, other);
  state_.massCount = scene_.plant->massCount();
  state_.handCount = static_cast<std::int32_t>(others_.size()) + 1;
  state_.rendersForce = options.rendersForce;
  bool allVirtual = options.virtualHand;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    state_.others[i].rendersForce = options.others[i].rendersForce;
    allVirtual = allVirtual && options.others[i].virtualHand;
  }
  if (allVirtual) settings_.startTimeoutTicks = settings_.timeoutTicks + settings_.restTicks;
  port_.lastSeen = settings_.start;
  for (Port& port : others_) port.lastSeen = settings_.start;
  putUp();
}

void TickEngine::putUp(Port& port) noexcept {
  port.fpOffset = {};
  port.anchorTicks = 0;
  port.broken = port.clamped = false;
  port.safety.rearm();
  port.observer.reset();
}

void TickEngine::putUp() noexcept {
  dynamics::Plant& plant = *scene_.plant;
  plant.placeAtRest(start_);
  plant.observe({settings_.start, {}, true}, state_.masses);
  for (int i = 0; i < state_.massCount; ++i) state_.masses[i].a = {};
  state_.body = plant.body();
  forceStatus_ = dynamics::StepStatus::Ok;
  putUp(port_);
  for (Port& port : others_) putUp(port);
}

dynamics::HandSample TickEngine::takeHand(Port& port, const DeviceSample& device, std::uint32_t missedTicks) noexcept {
  dynamics::HandSample hand{port.lastSeen, {}, false};
  const bool finite = isFinite(device.position) && (!device.hasVelocity || isFinite(device.velocity));
  if (!finite) port.broken = true;
  if (!device.valid || port.broken) {
    port.lost = true;
    return hand;
  }
  const bool anew = port.lost || (missedTicks > kGapTicks && !port.virtualHand);
  if (anew || norm(device.position - port.lastRaw) > dynamics::kLargestJump) port.estimator.reset();
  port.lastRaw = device.position;
  Vec3 place = device.position - port.fpOffset;
  hand.velocity = port.estimator.estimate(device);
  hand.valid = true;
  if (anew && trial::isEngaged(protocol_.phase)) {
    port.anchor = port.lastSeen - place;
    port.anchorTicks = kReanchorTicks;
  }
  port.lost = false;
  if (port.anchorTicks > 0) {
    const Blend blend = fadeOut(1 - static_cast<double>(port.anchorTicks) / kReanchorTicks);
    place += blend.value * port.anchor;
    hand.velocity += (blend.rate / (kReanchorTicks * kTickSeconds)) * port.anchor;
    --port.anchorTicks;
  }
  hand.position = port.lastSeen = place;
  return hand;
}

// A device that is not there is a lost hand.
void TickEngine::takeOthers(const TickInput& input) noexcept {
  for (std::size_t i = 0; i < others_.size(); ++i) {
    HandState& hand = state_.others[i];
    if (i < input.others.size()) hand.device = input.others[i];
    else hand.device.valid = false;
    hand.hand = takeHand(others_[i], hand.device, input.missedTicks);
  }
}

void TickEngine::tellOthers() noexcept {
  for (std::size_t i = 0; i < others_.size(); ++i)
    scene_.shared->setHand(static_cast<int>(i) + 1, others_[i].path.segment(), state_.others[i].hand);
}

bool TickEngine::allValid(const dynamics::HandSample& hand) const noexcept {
  bool valid = hand.valid;
  for (std::size_t i = 0; i < others_.size(); ++i) valid = valid && state_.others[i].hand.valid;
  return valid;
}

dynamics::StepStatus TickEngine::stepObject(const dynamics::HandSample& hand) noexcept {
  bool continuous = port_.path.push(hand);
  for (std::size_t i = 0; i < others_.size(); ++i) continuous = others_[i].path.push(state_.others[i].hand) && continuous;
  if (!others_.empty()) tellOthers();
  if (!allValid(hand)) return dynamics::StepStatus::HandLost;
  if (!continuous) scene_.plant->restart();
  return scene_.plant->step(port_.path.segment(needsVelocity_), kTickSeconds);
}

void TickEngine::observeMasses(const dynamics::HandSample& hand) noexcept {
  const std::span<const dynamics::MassState> masses{state_.masses.data(), static_cast<std::size_t>(state_.massCount)};
  const auto isDue = [&](std::uint32_t every) { return every != 0 && state_.tick % every == 0; };
  const bool looked = isDue(lookedAtEvery_), many = state_.massCount >= kManyMasses;
  if (ends_ != nullptr && (!looked || (many && !isDue(massesEvery_))) && ends_->observeEnds(state_.masses) &&
      !trial::needsEveryMass(settings_, protocol_, state_.tick, masses)) {
    sawAll_ = false;
    return;
  }
  scene_.plant->observe(hand, state_.masses);
  sawAll_ = looked;
}

// At arming the FP is placed on the HIP: the hand is seen where the FP is, in mass 1 or fixed to the body, which still is as it was put up.
void TickEngine::placeFixedPoint(Port& port, dynamics::HandSample& hand, const Vec3& fixedPoint) noexcept {
  port.fpOffset = hand.position - fixedPoint;
  hand.position = port.lastSeen = fixedPoint;
  port.path.reset();
  port.path.push(hand);
}

void TickEngine::placeFixedPoints(dynamics::HandSample& hand) noexcept {
  placeFixedPoint(port_, hand, scene_.shared != nullptr ? scene_.shared->fixedPoint(0) : state_.masses[0].r + port_.fpInBody);
  for (std::size_t i = 0; i < others_.size(); ++i)
    placeFixedPoint(others_[i], state_.others[i].hand, scene_.shared->fixedPoint(static_cast<int>(i) + 1));
  if (!others_.empty()) tellOthers();
  scene_.plant->restart();
}

trial::ProtocolInput TickEngine::protocolInput(const TickInput& input, const dynamics::HandSample& hand,
                                               dynamics::StepStatus status) noexcept {
  trial::ProtocolInput seen{state_.tick,
                            input.command,
                            input.planned,
                            input.device.position,
                            norm(hand.velocity),
                            hand.valid,
                            port_.broken,
                            port_.clamped,
                            status,
                            {state_.masses.data(), static_cast<std::size_t>(state_.massCount)},
                            input.missedTicks};
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const HandState& other = state_.others[i];
    seen.hipSpeed = std::max(seen.hipSpeed, norm(other.hand.velocity));
    seen.handValid = seen.handValid && other.hand.valid;
    seen.handBroken = seen.handBroken || others_[i].broken;
    seen.clamped = seen.clamped || others_[i].clamped;
    otherHips_[i] = other.device.position;
  }
  seen.otherHips = {otherHips_.data(), others_.size()};
  return seen;
}

void TickEngine::tick(const TickInput& input) noexcept {
  dynamics::Plant& plant = *scene_.plant;
  ++state_.tick;
  state_.measuredNs = input.measuredNs;
  state_.faults.missedTicks += input.missedTicks;
  cue_.reset();
  sawAll_ = true;

  const trial::Phase before = protocol_.phase;
  if (input.command == trial::Command::NextTrial && (before == trial::Phase::Idle || before == trial::Phase::Done)) {
    putUp();
    cue_ = Cue::Place;
  }
  dynamics::HandSample hand = takeHand(port_, input.device, input.missedTicks);
  if (!others_.empty()) takeOthers(input);
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  if (trial::isEngaged(before)) {
    status = stepObject(hand);
    observeMasses(hand);
    if (status == dynamics::StepStatus::Ok) status = forceStatus_;
  }

  const bool wasGone = protocol_.gone;
  trial::advance(settings_, protocolInput(input, hand, status), protocol_);
  if (!sawAll_ && !trial::isEngaged(protocol_.phase)) {  // as it ended, so it is shown and recorded from now on
    plant.observe(hand, state_.masses);
    sawAll_ = true;
  }
  if (before == trial::Phase::Waiting && protocol_.phase == trial::Phase::Armed) {
    placeFixedPoints(hand);
    plant.observe(hand, state_.masses);
  }
  if (protocol_.gone && (!wasGone || before == trial::Phase::Waiting)) cue_ = Cue::Go;

  state_.device = input.device;  // no sooner: what was just written in parts is waited for when it is copied as a whole
  state_.hand = hand;
  exertForces(hand, status, input.missedTicks);
  state_.deviceState = deviceState(port_, input.device, input.deviceFault);
  for (std::size_t i = 0; i < others_.size(); ++i)
    state_.others[i].deviceState = deviceState(others_[i], state_.others[i].device, input.deviceFault);
  state_.phase = protocol_.phase;
  state_.semaphore = protocol_.semaphore;
  state_.gone = protocol_.gone;
  state_.trial = protocol_.trial;
  state_.trialTime = protocol_.phase == trial::Phase::Moving ? static_cast<double>(state_.tick - protocol_.onsetTick) * kTickSeconds
                                                             : protocol_.result.movementTime;
  state_.result = protocol_.result;
}

// What acts beside the object: the workspace's wall, and the passivity controller where it is wanted.
Vec3 TickEngine::guardForce(Port& port, HandState& out, const dynamics::HandSample& hand, bool engaged) noexcept {
  out.interventions = 0;
  if (hand.valid) port.observer.observe(out.device.position);
  out.portEnergy = port.observer.energy();
  if (!engaged) return {};
  const Vec3 wall = wallForce(port.guards, out.device.position, hand.velocity);
  if (!(wall == Vec3{})) out.interventions |= intervention::kWall;
  const Vec3 dissipation = port.guards.passivityControl ? port.observer.control(hand.velocity) : Vec3{};
  if (!(dissipation == Vec3{})) out.interventions |= intervention::kPassivity;
  return wall + dissipation;
}

DeviceState TickEngine::deviceState(const Port& port, const DeviceSample& device, bool fault) const noexcept {
  if (fault || port.safety.latched()) return DeviceState::Fault;
  if (!device.valid && !device.released) return DeviceState::Off;
  if (trial::isEngaged(protocol_.phase)) return DeviceState::Engaged;
  return protocol_.phase == trial::Phase::Waiting ? DeviceState::Armed : DeviceState::Homed;
}

// `out.feedbackForce` becomes what the device is given.
void TickEngine::exertForce(Port& port, HandState& out, const dynamics::HandSample& hand, bool held, std::uint32_t missedTicks) noexcept {
  const bool engaged = trial::isEngaged(protocol_.phase);
  out.feedbackForce = -out.couplingForce;
  const Vec3 added = guardForce(port, out, hand, engaged && held);
  const bool weighs = !(port.guards.compensation == Vec3{});
  Vec3 asked = out.feedbackForce;
  if (!(added == Vec3{})) asked += added;
  if (weighs) asked += port.guards.compensation;
  out.deviceForce = port.safety.limit(asked, engaged || weighs, held && missedTicks <= kGapTicks);
  port.observer.render(weighs && !(out.deviceForce == Vec3{}) ? out.deviceForce - port.guards.compensation : out.deviceForce);
  out.clamped = !(out.deviceForce == asked);
  out.interventions |= port.safety.interventions();
  port.clamped = norm(out.feedbackForce) > port.safety.limit();
}

void TickEngine::exertForces(const dynamics::HandSample& hand, dynamics::StepStatus status, std::uint32_t missedTicks) noexcept {
  const dynamics::Plant& plant = *scene_.plant;
  const bool engaged = trial::isEngaged(protocol_.phase);
  const bool held = (others_.empty() ? hand.valid : allValid(hand)) && status == dynamics::StepStatus::Ok;
  const bool acts = engaged && held;
  state_.couplingForce = acts ? plant.couplingForce(hand) : Vec3{};
  if (!acts) state_.energy = 0;
  else if (sawAll_) state_.energy = plant.energy(hand);
  bool finite = isFinite(state_.couplingForce);
  for (std::size_t i = 0; i < others_.size(); ++i) {
    HandState& other = state_.others[i];
    const int number = static_cast<int>(i) + 1;
    other.couplingForce = acts ? scene_.shared->couplingForceOf(number) : Vec3{};
    other.work = scene_.shared->work(number);
    finite = finite && isFinite(other.couplingForce);
  }
  if (scene_.shared != nullptr) state_.work = scene_.shared->work(0);
  if (!finite) forceStatus_ = status = dynamics::StepStatus::NotFinite;
  exertForce(port_, state_, hand, held, missedTicks);
  bool clamped = state_.clamped;
  for (std::size_t i = 0; i < others_.size(); ++i) {
    exertForce(others_[i], state_.others[i], state_.others[i].hand, held, missedTicks);
    clamped = clamped || state_.others[i].clamped;
  }
  if (engaged && clamped) ++state_.faults.clampedTicks;
  if (engaged) {
    ++state_.faults.steps[static_cast<std::size_t>(status)];
    state_.body = plant.body();
  }
  state_.status = status;
}

}  // namespace reachlab::haptics
