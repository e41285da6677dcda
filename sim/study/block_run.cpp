#include "sim/study/block_run.h"

#include "base/fault.h"
#include "base/ticks.h"
#include "sim/dynamics/compiled_scene.h"

namespace reachlab::study {
namespace {

std::unique_ptr<haptics::HapticDevice> checked(std::unique_ptr<haptics::HapticDevice> hand) {
  const haptics::DeviceInfo info = hand->info();
  if (!info.virtualHand || info.rendersForce)
    throw FaultError(Fault{"subject", "is " + info.name + ", which a study cannot ask", "a simulated subject"});
  return hand;
}

}  // namespace

BlockRun::BlockRun(const experiment::CompiledExperiment& experiment, std::unique_ptr<haptics::HapticDevice> hand, bool withSamples)
    : hand_(checked(std::move(hand))),
      engine_(experiment.experiment(), dynamics::compileScene(experiment), haptics::engineOptions(hand_->info())),
      withSamples_(withSamples) {
  if (withSamples_) table_ = record::makeChannelTable(experiment.experiment(), experiment.constraint().parameterCount(), false);
  rows_.columns = table_.size();
}

// What the haptic loop does at one tick of the virtual clock, for a hand that no watch looks after.
void BlockRun::tick(const haptics::TickInput& order) {
  const haptics::TickState& state = engine_.state();
  haptics::TickInput input = order;
  input.device = hand_->read();
  input.measuredNs = static_cast<std::int64_t>(state.tick) * kTickNs;
  engine_.tick(input);
  hand_->write(state.deviceForce);
  if (const auto cue = engine_.cue()) hand_->cue(*cue);
  hand_->see({state.masses.data(), static_cast<std::size_t>(state.massCount)});

  seen_.tick = state.tick;
  seen_.measuredNs = input.measuredNs;
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
  haptics::TickInput order;
  order.command = trial::Command::NextTrial;
  order.planned = planned;
  tick(order);
  const haptics::TickState& state = engine_.state();
  const haptics::TickInput none;
  while (state.phase != trial::Phase::Done) tick(none);
  tick(none);  // one in Done, as whoever conducts a recorded run has it
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
