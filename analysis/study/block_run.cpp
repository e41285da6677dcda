#include "analysis/study/block_run.h"

#include <new>

#include "base/fault.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "sim/dynamics/scene.h"
#include "sim/haptics/blind_hand.h"
#include "sim/haptics/tick_order.h"

namespace reachlab::study {
namespace {

std::unique_ptr<haptics::HapticDevice> checked(std::unique_ptr<haptics::HapticDevice> hand) {
  const haptics::DeviceInfo info = hand->info();
  if (!info.virtualHand || info.rendersForce)
    throw FaultError(Fault{"subject", "is " + info.name + ", which a study cannot ask", "a simulated subject"});
  return hand;
}

}  // namespace

BlockRun::BlockRun(std::span<const experiment::CompiledExperiment> experiments, bool withSamples)
    : experiments_(experiments), scenes_(dynamics::compileScenes(experiments)), withSamples_(withSamples) {
  if (withSamples_)
    table_ = record::makeChannelTable(record::channelsOfAll(experiments), experiments.front().constraint().parameterCount(), false);
  rows_.columns = table_.size();
}

void BlockRun::begin(std::unique_ptr<haptics::HapticDevice> hand) {
  hand_ = checked(std::move(hand));
  if (engine_) scenes_ = std::move(*engine_).takeScenes();
  engine_.emplace(experiments_, std::move(scenes_), haptics::engineOptions(*hand_));
  if (dynamic_cast<const haptics::BlindHand*>(hand_.get()) != nullptr) engine_->setLookedAtEvery(withSamples_ ? kSampleEvery : 0);
  tracker_ = record::TrialTracker();
  trial_ = 0;
}

struct BlockRun::Stages : haptics::NoStages {
  BlockRun& block;
  trial::Command order;
  const trial::PlannedTrial& planned;
  Stages(BlockRun& theBlock, trial::Command theOrder, const trial::PlannedTrial& thePlanned)
      : block(theBlock), order(theOrder), planned(thePlanned) {}

  bool read(haptics::TickInput& input) noexcept {
    // Into its place: a copy of what was just written in parts is waited for.
    ::new (&input.devices[0]) haptics::DeviceSample(block.hand_->read());
    return true;
  }
  void command(haptics::TickInput& input) noexcept {
    input.command = order;
    input.planned = planned;
  }
  bool write(const haptics::TickInput&) noexcept {
    const haptics::TickState& state = block.engine_->state();
    block.hand_->write(state.hands[0].deviceForce);
    if (const auto cue = block.engine_->cue()) block.hand_->cue(*cue);
    block.hand_->see({state.masses.data(), static_cast<std::size_t>(state.massCount)});
    return true;
  }
  void publish(const haptics::TickInput& input) {
    const haptics::TickState& state = block.engine_->state();
    block.tracker_.add({.tick = state.tick, .measuredNs = input.measuredNs}, record::factsOf(state), block.events_);
    block.events_.clear();
    if (block.withSamples_ && state.tick % kSampleEvery == 0) block.keepRow(state);
  }
};

// On the virtual clock. No watch looks after a simulated hand.
void BlockRun::tick(trial::Command command, const trial::PlannedTrial& planned) {
  input_.measuredNs = static_cast<std::int64_t>(engine_->state().tick) * kTickNs;
  haptics::runTick(*engine_, input_, Stages(*this, command, planned));
}

void BlockRun::keepRow(const haptics::TickState& state) {
  rows_.ticks.push_back(state.tick);
  rows_.values.resize(rows_.values.size() + rows_.columns);
  record::fillRow(table_, state, rows_.values.data() + rows_.values.size() - rows_.columns);
}

const record::RecordedTrial& BlockRun::runTrial(const trial::PlannedTrial& planned) {
  hand_->prepareTrial(planned.index, planned.scene);
  rows_.ticks.clear();
  rows_.values.clear();
  ++trial_;
  tracker_.announce({trial_, planned});
  tick(trial::Command::NextTrial, planned);
  while (engine_->state().phase != trial::Phase::Done) tick(trial::Command::None, planned);
  tick(trial::Command::None, planned);  // one in Done, as whoever conducts a recorded run has it
  return tracker_.trial();
}

}  // namespace reachlab::study
