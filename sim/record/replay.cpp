#include "sim/record/replay.h"

#include <fmt/format.h>

#include <cstring>
#include <memory>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/record/log/trial_tracker.h"

namespace reachlab::record {
namespace {

constexpr std::size_t kMeasuredTime = 1;  // the one column that is the computer's and not the simulation's

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool sameResult(const trial::TrialResult& a, const trial::TrialResult& b) {
  return a.outcome == b.outcome && a.reason == b.reason && a.mass == b.mass && sameBits(a.by, b.by) &&
         sameBits(a.movementTime, b.movementTime) && a.onsetTick == b.onsetTick && a.endTick == b.endTick;
}

// Holds simulated rows against the recorded ones, in step.
class RowCheck {
 public:
  explicit RowCheck(const RunLog& log)
      : table_(log.configuration().table), firstTrial_(log.configuration().firstTrial), recorded_(log.allRows()), row_(table_.size()) {}

  void look(const haptics::TickState& state, const ReplayHooks& hooks, Replay& replay) {
    if (next_ >= recorded_.size() || recorded_.ticks[next_] != state.tick) return;
    fillRow(table_, state, row_.data());
    numberTrial(table_, firstTrial_, row_.data());
    const std::size_t scene = rowWidth(table_);
    const bool further = hooks.further && table_.size() > scene;
    if (further) hooks.further(row_.data() + scene);
    ++replay.rows;
    for (std::size_t column = 0; column < (further ? table_.size() : scene); ++column) {
      const double recorded = recorded_.at(next_, column);
      if (column == kMeasuredTime || sameBits(recorded, row_[column])) continue;
      if (replay.firstDifference.empty())
        replay.firstDifference = fmt::format("tick {}, {}: recorded {:.17g}, simulated {:.17g}", state.tick, table_.channels[column].name,
                                             recorded, row_[column]);
      ++replay.rowsThatDiffer;
      break;
    }
    ++next_;
  }

 private:
  const ChannelTable& table_;
  int firstTrial_;
  SampleRows recorded_;
  std::vector<double> row_;
  std::size_t next_ = 0;
};

void compareTrials(const RunLog& log, Replay& replay) {
  std::size_t simulated = 0;
  for (const RecordedTrial& recorded : log.trials()) {
    if (!recorded.complete || recorded.result.reason == trial::Reason::Program) continue;  // broken off: there is no result to compare
    if (simulated < replay.trials.size() && sameResult(recorded.result, replay.trials[simulated].result)) {
      ++simulated;
      continue;
    }
    ++simulated;
    ++replay.trialsThatDiffer;
    if (replay.firstDifference.empty()) replay.firstDifference = fmt::format("trial {}: the result differs", recorded.trial);
  }
}

}  // namespace

Replay replayRun(const RunLog& log) { return replayRun(log, {}); }

Replay replayRun(const RunLog& log, const ReplayHooks& hooks) {
  const RunConfiguration& c = log.configuration();
  const experiment::CompiledExperiment compiled = recordedExperiment(c);
  const experiment::Experiment& experiment = compiled.experiment();
  haptics::EngineOptions options{
      c.deviceMaxForce, c.virtualHand, c.rendersForce, c.deviceContinuousForce, c.deviceThermalSeconds, c.guards, {}};
  for (const HandDevice& hand : c.otherHands)
    options.others.push_back(
        {hand.maxForce, hand.virtualHand, hand.rendersForce, hand.continuousForce, hand.thermalSeconds, hand.guards, {}});
  const auto made = hooks.makeEngine ? hooks.makeEngine(compiled, options) : std::make_unique<haptics::TickEngine>(compiled, options);
  haptics::TickEngine& engine = *made;
  experiment::Experiment recorded = experiment;
  if (hooks.makeEngine) recorded.hands.clear();  // a station's own hand alone
  const ChannelTable scene = makeChannelTable(recorded, engine.constraint().parameterCount());
  if (c.table.massCount != scene.massCount || c.table.parameterCount != scene.parameterCount || c.table.body != scene.body ||
      c.table.hands != scene.hands)
    throw FaultError(
        Fault{"table", "has not the masses and hands of its experiment, so the run cannot be simulated again", {}, FilePlace{log.path()}});
  const std::vector<TrialSetup> setups = log.setups();
  RowCheck rows(log);
  TrialTracker tracker(c.firstTrial);
  std::vector<RecordedEvent> events;
  Replay replay;
  const std::vector<std::vector<haptics::DeviceSample>> otherTicks = log.otherTicks();
  std::vector<haptics::DeviceSample> others(otherTicks.size());
  std::size_t setup = 0, number = 0;
  std::uint64_t expected = 0;
  const auto finished = [&] {
    compareTrials(log, replay);
    return replay;
  };
  for (const RecordedTick& tick : log.ticks()) {
    haptics::TickInput input{tick.device, tick.command, {}, tick.missedTicks, tick.measuredNs};
    for (std::size_t hand = 0; hand < others.size(); ++hand) {
      if (number >= otherTicks[hand].size()) return finished();
      others[hand] = otherTicks[hand][number];
    }
    input.others = others;
    ++number;
    if (tick.command == trial::Command::NextTrial && setup < setups.size()) {
      tracker.announce(setups[setup]);
      input.planned = setups[setup++].planned;
    }
    engine.tick(input);
    const haptics::TickState& state = engine.state();
    if (replay.ticks == 0) expected = tick.tick;
    if (tick.tick != expected || state.tick != tick.tick)
      throw FaultError(Fault{{},
                             fmt::format("tick {} is missing (dropped while recording), so the run cannot be simulated past it", expected),
                             {},
                             FilePlace{log.path()}});
    ++expected;
    ++replay.ticks;
    rows.look(state, hooks, replay);
    if (hooks.afterTick) hooks.afterTick(state);
    if (tracker.add(tick, factsOf(state), events).finished) replay.trials.push_back(tracker.trial());
  }
  return finished();
}

}  // namespace reachlab::record
