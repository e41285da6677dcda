#include "analysis/study/block_run.h"

#include "base/fault.h"
#include "base/ticks.h"
#include "sim/dynamics/compiled_scene.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/haptics/blind_hand.h"

namespace reachlab::study {
namespace {

std::unique_ptr<haptics::HapticDevice> checked(std::unique_ptr<haptics::HapticDevice> hand) {
  const haptics::DeviceInfo info = hand->info();
  if (!info.virtualHand || info.rendersForce)
    throw FaultError(Fault{"subject", "is " + info.name + ", which a study cannot ask", "a simulated subject"});
  return hand;
}

// A scene moves without a task, a trial does not.
dynamics::Scene compileWithTask(const experiment::CompiledExperiment& experiment) {
  (void)experiment::requiredTask(experiment.experiment());
  return dynamics::compileScene(experiment);
}

}  // namespace

BlockRun::BlockRun(const experiment::CompiledExperiment& experiment, bool withSamples)
    : experiment_(&experiment), scene_(compileWithTask(experiment)), withSamples_(withSamples) {
  if (withSamples_) table_ = record::makeChannelTable(experiment.experiment(), experiment.constraint().parameterCount(), false);
  rows_.columns = table_.size();
}

void BlockRun::begin(std::unique_ptr<haptics::HapticDevice> hand) {
  hand_ = checked(std::move(hand));
  if (engine_) scene_ = std::move(*engine_).takeScene();
  engine_.emplace(experiment_->experiment(), std::move(scene_), haptics::engineOptions(hand_->info()));
  if (dynamic_cast<const haptics::BlindHand*>(hand_.get()) != nullptr) engine_->setLookedAtEvery(withSamples_ ? kSampleEvery : 0);
  tracker_ = record::TrialTracker();
  seen_ = {};
  trial_ = 0;
}

// What the haptic loop does at one tick of the virtual clock, for a hand that no watch looks after.
void BlockRun::tick(trial::Command command, const trial::PlannedTrial& planned) {
  haptics::TickEngine& engine = *engine_;
  const haptics::TickState& state = engine.state();
  const std::int64_t now = static_cast<std::int64_t>(state.tick) * kTickNs;
  // Read into its place: a copy of what was just written in parts is waited for.
  const haptics::TickInput input{.device = hand_->read(), .command = command, .planned = planned, .measuredNs = now};
  engine.tick(input);
  hand_->write(state.deviceForce);
  if (const auto cue = engine.cue()) hand_->cue(*cue);
  hand_->see({state.masses.data(), static_cast<std::size_t>(state.massCount)});

  seen_.tick = state.tick;
  seen_.measuredNs = now;
  seen_.device.valid = input.device.valid;
  tracker_.add(seen_, record::factsOf(state), events_);
  events_.clear();
  if (withSamples_ && state.tick % kSampleEvery == 0) keepRow(state);
}

void BlockRun::keepRow(const haptics::TickState& state) {
  rows_.ticks.push_back(state.tick);
  rows_.values.resize(rows_.values.size() + rows_.columns);
  record::fillRow(table_, state, rows_.values.data() + rows_.values.size() - rows_.columns);
}

const record::RecordedTrial& BlockRun::runTrial(const trial::PlannedTrial& planned) {
  hand_->prepareTrial(planned.index);
  rows_.ticks.clear();
  rows_.values.clear();
  ++trial_;
  tracker_.announce({trial_, planned});
  tick(trial::Command::NextTrial, planned);
  while (engine_->state().phase != trial::Phase::Done) tick(trial::Command::None, planned);
  tick(trial::Command::None, planned);  // one in Done, as whoever conducts a recorded run has it
  return tracker_.trial();
}

record::SampleRows BlockRun::rowsBetween(std::uint64_t first, std::uint64_t last) const {
  record::SampleRows rows;
  rows.columns = rows_.columns;
  for (std::size_t i = 0; i < rows_.ticks.size(); ++i) {
    if (rows_.ticks[i] < first || rows_.ticks[i] > last) continue;
    rows.ticks.push_back(rows_.ticks[i]);
    const auto begin = rows_.values.begin() + static_cast<std::ptrdiff_t>(i * rows_.columns);
    rows.values.insert(rows.values.end(), begin, begin + static_cast<std::ptrdiff_t>(rows_.columns));
  }
  return rows;
}

}  // namespace reachlab::study
