#include "sim/haptics/tick_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/fault.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "sim/dynamics/shared_plant.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/same_record.h"

namespace reachlab::haptics {
namespace {

// 1 at x = 0, 0 at x = 1, at rest at both ends (1 minus the minimum-jerk law), and its derivative.
struct Blend {
  double value, rate;
};
Blend fadeOut(double x) noexcept { return {1 - minimumJerk(x), -minimumJerkRate(x)}; }

void requireHands(const experiment::Experiment& experiment, std::size_t devices) {
  const std::size_t hands = std::max<std::size_t>(experiment.hands.size(), 1);
  if (hands != devices)
    throw FaultError(Fault{
        "device",
        fmt::format("is {} device{} where the experiment has {} hand{}", devices, devices == 1 ? "" : "s", hands, hands == 1 ? "" : "s"),
        "a device for each of the experiment's hands"});
}

ForceLimits limitsFor(const experiment::Experiment& experiment, const DeviceInfo& device) {
  double most = experiment.forceLimit.value_or(device.maxForce);
  if (device.rendersForce) most = std::min(most, device.maxForce);
  return {most, device.rendersForce ? device.maxContinuousForce : 0, device.thermalSeconds};
}

}  // namespace

EngineOptions engineOptions(HapticDevice& device) {
  EngineOptions options{{}};
  for (const HapticDevice* hand : device.hands()) options.hands.push_back(hand->info());
  return options;
}

TickEngine::TickEngine(const experiment::Experiment& experiment, const EngineOptions& options)
    : TickEngine(experiment, (experiment::requiredTask(experiment), dynamics::compileScene(experiment)), options) {}

TickEngine::TickEngine(const experiment::CompiledExperiment& experiment, const EngineOptions& options)
    : TickEngine(experiment.experiment(), (experiment::requiredTask(experiment.experiment()), dynamics::compileScene(experiment)),
                 options) {}

TickEngine::TickEngine(std::span<const experiment::CompiledExperiment> scenes, const EngineOptions& options)
    : TickEngine(scenes, dynamics::compileScenes(scenes), options) {}

TickEngine::TickEngine(const experiment::Experiment& experiment, dynamics::Scene scene, const EngineOptions& options) {
  stages_.emplace_back(experiment, std::move(scene));
  begin(experiment, options);
}

TickEngine::TickEngine(std::span<const experiment::CompiledExperiment> experiments, std::vector<dynamics::Scene> scenes,
                       const EngineOptions& options) {
  const experiment::Experiment& first = experiments.front().experiment();
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (const auto fault = experiment::differenceInRecord(first, experiments[i].experiment())) throw FaultError(*fault);
    stages_.emplace_back(experiments[i].experiment(), std::move(scenes.at(i)));
  }
  begin(first, options);
}

TickEngine::Stage::Stage(const experiment::Experiment& experiment, dynamics::Scene compiled)
    : scene(std::move(compiled)), ends(dynamic_cast<const dynamics::EndMasses*>(scene.plant.get())),
      needsVelocity(scene.plant->needsHandVelocity()), start(experiment::requiredTask(experiment).start),
      settings(trial::makeProtocolSettings(experiment, *scene.constraint)),
      fpInBody(experiment.object.kind == experiment::ObjectKind::Body ? experiment.object.fpOffset : Vec3{}) {
  settings.judgesHand = experiment.object.kind == experiment::ObjectKind::None;
  if (!experiment.environment.empty()) field.emplace(experiment.environment, experiment.arm, settings.start, settings.target);
  if (experiment.cursor) cursor.emplace(*experiment.cursor, experiment.task->plane, settings.start, settings.target);
}

TickEngine::Hand::Hand(const experiment::Experiment& experiment, const DeviceInfo& device)
    : virtualHand(device.virtualHand), estimator(experiment.velocityEstimator), path(4), safety(limitsFor(experiment, device)),
      guards(device.guards), guarded(device.rendersForce || guards.wallRadius > 0 || guards.passivityControl) {}

void TickEngine::begin(const experiment::Experiment& experiment, const EngineOptions& options) {
  now_ = &stages_.front();
  // A station moves its own hand alone, so its scene takes one device even where the experiment has several hands.
  if (now_->scene.shared != nullptr || experiment.hands.empty()) requireHands(experiment, options.hands.size());
  else if (options.hands.size() != 1)
    throw FaultError(Fault{"device", fmt::format("is {} devices at a station", options.hands.size()), "one device: a station is one hand"});
  state_.massCount = now_->scene.plant->massCount();
  state_.handCount = static_cast<std::int32_t>(options.hands.size());
  bool allVirtual = true;
  for (const DeviceInfo& hand : options.hands) {
    state_.hands[hands_.size()].rendersForce = hand.rendersForce;
    hands_.emplace_back(experiment, hand).lastSeen = now_->settings.start;
    allVirtual = allVirtual && hand.virtualHand;
  }
  for (const Stage& stage : stages_) state_.hasEnvironment = state_.hasEnvironment || stage.field || stage.cursor;
  for (Stage& stage : stages_)
    if (allVirtual) stage.settings.startTimeoutTicks = stage.settings.timeoutTicks + stage.settings.restTicks;
  queueTrial(0);
}

std::vector<dynamics::Scene> TickEngine::takeScenes() && {
  std::vector<dynamics::Scene> scenes;
  for (Stage& stage : stages_) scenes.push_back(std::move(stage.scene));
  return scenes;
}

// Every scene is compiled already, so that changing to it is one pointer.
void TickEngine::queueTrial(int scene) noexcept {
  now_ = &stages_[static_cast<std::size_t>(std::clamp(scene, 0, static_cast<int>(stages_.size()) - 1))];
  dynamics::Plant& plant = *now_->scene.plant;
  plant.placeAtRest(now_->start);
  plant.observe({now_->settings.start, {}, true}, state_.masses);
  for (int i = 0; i < state_.massCount; ++i) state_.masses[i].a = {};
  state_.body = plant.body();
  forceStatus_ = dynamics::StepStatus::Ok;
  if (now_->field) now_->field->reset();
  state_.environment.channelBroken = false;
  for (Hand& hand : hands_) {
    hand.fpOffset = {};
    hand.anchorTicks = 0;
    hand.broken = hand.clamped = false;
    hand.safety.rearm();
    hand.observer.reset();
  }
}

// In place: what was just written in parts is waited for when it is copied as a whole.
void TickEngine::takeHand(Hand& hand, const DeviceSample& device, std::uint32_t missedTicks, dynamics::HandSample& hip) noexcept {
  hip.position = hand.lastSeen;
  hip.velocity = {};
  hip.valid = false;
  const bool finite = isFinite(device.position) && (!device.hasVelocity || isFinite(device.velocity));
  if (!finite) hand.broken = true;
  if (!device.valid || hand.broken) {
    hand.lost = true;
    return;
  }
  const bool anew = hand.lost || (missedTicks > kGapTicks && !hand.virtualHand);
  if (anew || norm(device.position - hand.lastRaw) > dynamics::kLargestJump) hand.estimator.reset();
  hand.lastRaw = device.position;
  Vec3 place = device.position - hand.fpOffset;
  hip.velocity = hand.estimator.estimate(device);
  hip.valid = true;
  if (anew && trial::isEngaged(protocol_.phase)) {
    hand.anchor = hand.lastSeen - place;
    hand.anchorTicks = kReanchorTicks;
  }
  hand.lost = false;
  if (hand.anchorTicks > 0) {
    const Blend blend = fadeOut(1 - static_cast<double>(hand.anchorTicks) / kReanchorTicks);
    place += blend.value * hand.anchor;
    hip.velocity += (blend.rate / (kReanchorTicks * kTickSeconds)) * hand.anchor;
    --hand.anchorTicks;
  }
  hip.position = hand.lastSeen = place;
}

// The plant itself takes the first hand.
void TickEngine::tellSharedHands() noexcept {
  for (std::size_t i = 1; i < hands_.size(); ++i)
    now_->scene.shared->setHand(static_cast<int>(i), hands_[i].path.segment(), state_.hands[i].hip);
}

bool TickEngine::allValid() const noexcept {
  return std::all_of(state_.hands.begin(), state_.hands.begin() + state_.handCount, [](const HandState& hand) { return hand.hip.valid; });
}

dynamics::StepStatus TickEngine::stepObject() noexcept {
  bool continuous = true;
  for (std::size_t i = 0; i < hands_.size(); ++i) continuous = hands_[i].path.push(state_.hands[i].hip) && continuous;
  tellSharedHands();
  if (!allValid()) return dynamics::StepStatus::HandLost;
  if (!continuous) now_->scene.plant->restart();
  return now_->scene.plant->step(hands_.front().path.segment(now_->needsVelocity), kTickSeconds);
}

void TickEngine::observeMasses() noexcept {
  const std::span<const dynamics::MassState> masses{state_.masses.data(), static_cast<std::size_t>(state_.massCount)};
  const auto isDue = [&](std::uint32_t every) { return every != 0 && state_.tick % every == 0; };
  const bool looked = isDue(lookedAtEvery_), many = state_.massCount >= kManyMasses;
  if (now_->ends != nullptr && (!looked || (many && !isDue(massesEvery_))) && now_->ends->observeEnds(state_.masses) &&
      !trial::needsEveryMass(now_->settings, protocol_, state_.tick, masses)) {
    sawAll_ = false;
    return;
  }
  now_->scene.plant->observe(state_.hands[0].hip, state_.masses);
  sawAll_ = looked;
}

// At arming the FP is placed on the HIP: the hand is seen where the FP is, in mass 1 or fixed to the body, which is still at its start.
void TickEngine::placeFixedPoints() noexcept {
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    Hand& hand = hands_[i];
    dynamics::HandSample& hip = state_.hands[i].hip;
    const Vec3 fixedPoint = now_->settings.judgesHand       ? hip.position  // there is no object to hold
                            : now_->scene.shared != nullptr ? now_->scene.shared->fixedPoint(static_cast<int>(i))
                                                            : state_.masses[0].r + now_->fpInBody;
    hand.fpOffset = hip.position - fixedPoint;
    hip.position = hand.lastSeen = fixedPoint;
    hand.path.reset();
    hand.path.push(hip);
  }
  tellSharedHands();
  now_->scene.plant->restart();
}

trial::ProtocolInput TickEngine::protocolInput(const TickInput& input, dynamics::StepStatus status) noexcept {
  trial::ProtocolInput seen;
  seen.tick = state_.tick;
  seen.command = input.command;
  seen.planned = input.planned;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const dynamics::HandSample& hip = state_.hands[i].hip;
    hips_[i] = input.devices[i].position;
    // An open dead-man switch is no loss: where the hand is stays known. It does not rest, so that no trial is armed.
    const bool released = input.devices[i].released;
    seen.hipSpeed = std::max(released ? std::numeric_limits<double>::infinity() : norm(hip.velocity), seen.hipSpeed);
    seen.handValid = seen.handValid && (hip.valid || released);
    seen.handBroken = seen.handBroken || hands_[i].broken;
    seen.clamped = seen.clamped || hands_[i].clamped;
  }
  seen.hips = {hips_.data(), hands_.size()};
  seen.status = status;
  seen.masses = {state_.masses.data(), static_cast<std::size_t>(state_.massCount)};
  if (now_->cursor && now_->cursor->isJudged()) {
    judged_ = state_.masses[0];
    judged_.r = (*now_->cursor)(judged_.r);
    seen.masses = {&judged_, 1};
  }
  seen.missedTicks = input.missedTicks;
  return seen;
}

void TickEngine::step(const TickInput& input) noexcept {
  ++state_.tick;
  state_.measuredNs = input.measuredNs;
  state_.faults.missedTicks += input.missedTicks;
  cue_.reset();
  sawAll_ = true;

  const trial::Phase before = protocol_.phase;
  if (input.command == trial::Command::NextTrial && (before == trial::Phase::Idle || before == trial::Phase::Done)) {
    queueTrial(input.planned.scene);
    cue_ = Cue::Place;
  }
  for (std::size_t i = 0; i < hands_.size(); ++i) takeHand(hands_[i], input.devices[i], input.missedTicks, state_.hands[i].hip);
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  if (trial::isEngaged(before)) {
    status = stepObject();
    observeMasses();
    if (status == dynamics::StepStatus::Ok) status = forceStatus_;
  } else if (now_->settings.judgesHand) {
    observeMasses();
  }

  const bool wasGone = protocol_.gone;
  trial::advance(now_->settings, protocolInput(input, status), protocol_);
  if (!sawAll_ && !trial::isEngaged(protocol_.phase)) {  // as it ended, so it is shown and recorded from now on
    now_->scene.plant->observe(state_.hands[0].hip, state_.masses);
    sawAll_ = true;
  }
  if (before == trial::Phase::Waiting && protocol_.phase == trial::Phase::Armed) {
    placeFixedPoints();
    now_->scene.plant->observe(state_.hands[0].hip, state_.masses);
  }
  if (protocol_.gone && (!wasGone || before == trial::Phase::Waiting)) cue_ = Cue::Go;
  if (now_->cursor) state_.masses[0].r = (*now_->cursor)(state_.masses[0].r);  // observed in this tick: the point that the subject sees

  state_.status = status;
  state_.phase = protocol_.phase;
  state_.semaphore = protocol_.semaphore;
  state_.gone = protocol_.gone;
  state_.trial = protocol_.trial;
  state_.viaPassed = protocol_.viaPassed;
  state_.trialTime = protocol_.phase == trial::Phase::Moving ? static_cast<double>(state_.tick - protocol_.onsetTick) * kTickSeconds
                                                             : protocol_.result.movementTime;
  state_.result = protocol_.result;
}

// What acts beside the object: the workspace's wall, and the passivity controller where it is wanted.
Vec3 TickEngine::guardForce(Hand& hand, HandState& out, bool engaged) noexcept {
  if (out.hip.valid) hand.observer.observe(out.device.position);
  out.portEnergy = hand.observer.energy();
  if (!engaged) return {};
  const Vec3 wall = wallForce(hand.guards, out.device.position, out.hip.velocity);
  if (!(wall == Vec3{})) out.interventions |= intervention::kWall;
  const Vec3 dissipation = hand.guards.passivityControl ? hand.observer.control(out.hip.velocity) : Vec3{};
  if (!(dissipation == Vec3{})) out.interventions |= intervention::kPassivity;
  return wall + dissipation;
}

DeviceState TickEngine::deviceState(const Hand& hand, const DeviceSample& device, bool fault) const noexcept {
  if (fault || hand.safety.latched()) return DeviceState::Fault;
  if (!device.valid && !device.released) return DeviceState::Off;
  if (trial::isEngaged(protocol_.phase)) return DeviceState::Engaged;
  return protocol_.phase == trial::Phase::Waiting ? DeviceState::Armed : DeviceState::Homed;
}

void TickEngine::exertCoupling(bool acts) noexcept {
  const dynamics::Plant& plant = *now_->scene.plant;
  state_.hands[0].couplingForce = acts ? plant.couplingForce(state_.hands[0].hip) : Vec3{};
  if (!acts) state_.energy = 0;
  else if (sawAll_) state_.energy = plant.energy(state_.hands[0].hip);
  if (now_->scene.shared == nullptr) return;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    const int number = static_cast<int>(i);
    if (i > 0) state_.hands[i].couplingForce = acts ? now_->scene.shared->couplingForceOf(number) : Vec3{};
    state_.hands[i].work = now_->scene.shared->work(number);
  }
}

// Added to the coupling's force before the safety layer. The laws count only ticks in which the hand is known.
void TickEngine::exertEnvironment(bool acts) noexcept {
  const dynamics::HandSample& hip = state_.hands[0].hip;
  EnvironmentState& out = state_.environment;
  out.force = now_->field && acts ? now_->field->step({true, state_.phase == trial::Phase::Moving, hip.position, hip.velocity}) : Vec3{};
  out.channelBroken = now_->field && now_->field->channelBroken();
  out.cursor = now_->cursor ? (*now_->cursor)(hip.position) : hip.position;
}

// `out.feedbackForce` becomes what the device is given.
void TickEngine::limitForce(Hand& hand, HandState& out, bool held, std::uint32_t missedTicks) noexcept {
  const bool engaged = trial::isEngaged(protocol_.phase);
  out.feedbackForce = state_.hasEnvironment ? state_.environment.force - out.couplingForce : -out.couplingForce;
  out.interventions = 0;
  const Vec3 added = hand.guarded ? guardForce(hand, out, engaged && held) : Vec3{};
  const bool weighs = !(hand.guards.compensation == Vec3{});
  Vec3 asked = out.feedbackForce;
  if (!(added == Vec3{})) asked += added;
  if (weighs) asked += hand.guards.compensation;
  out.deviceForce = hand.safety.limit(asked, engaged || weighs, held && missedTicks <= kGapTicks);
  if (hand.guarded)
    hand.observer.render(weighs && !(out.deviceForce == Vec3{}) ? out.deviceForce - hand.guards.compensation : out.deviceForce);
  out.clamped = !(out.deviceForce == asked);
  out.interventions |= hand.safety.interventions();
  hand.clamped = norm(out.feedbackForce) > hand.safety.limit();
}

void TickEngine::limit(const TickInput& input) noexcept {
  const bool engaged = trial::isEngaged(protocol_.phase);
  const bool held = allValid() && state_.status == dynamics::StepStatus::Ok;
  exertCoupling(engaged && held);
  if (state_.hasEnvironment) exertEnvironment(engaged && held);
  for (std::size_t i = 0; i < hands_.size(); ++i)
    if (!isFinite(state_.hands[i].couplingForce)) forceStatus_ = state_.status = dynamics::StepStatus::NotFinite;
  if (state_.hasEnvironment && !isFinite(state_.environment.force)) forceStatus_ = state_.status = dynamics::StepStatus::NotFinite;
  bool clamped = false;
  for (std::size_t i = 0; i < hands_.size(); ++i) {
    HandState& out = state_.hands[i];
    out.device = input.devices[i];  // only now: see takeHand
    limitForce(hands_[i], out, held, input.missedTicks);
    out.deviceState = deviceState(hands_[i], out.device, input.deviceFault);
    clamped = clamped || out.clamped;
  }
  if (!engaged) return;
  if (clamped) ++state_.faults.clampedTicks;
  ++state_.faults.steps[static_cast<std::size_t>(state_.status)];
  state_.body = now_->scene.plant->body();
}

}  // namespace reachlab::haptics
