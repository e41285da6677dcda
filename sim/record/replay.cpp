#include "sim/record/replay.h"

#include <fmt/format.h>

#include <cstring>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_order.h"
#include "sim/record/log/trial_tracker.h"

namespace reachlab::record {
namespace {

constexpr std::size_t kMeasuredTime = 1;  // the one column that is the computer's and not the simulation's

bool sameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

bool sameResult(const trial::TrialResult& a, const trial::TrialResult& b) {
  return a.outcome == b.outcome && a.reason == b.reason && a.mass == b.mass && sameBits(a.by, b.by) &&
         sameBits(a.movementTime, b.movementTime) && a.onsetTick == b.onsetTick && a.endTick == b.endTick;
}

void compareTrials(const RunLog& log, Replay& replay) {
  std::size_t simulated = 0;
  for (const RecordedTrial& recorded : log.trials()) {
    if (!recorded.complete || recorded.result.reason == trial::Reason::Program) continue;  // broken off: there is no result to compare
    if (simulated < replay.trials.size() && sameResult(recorded.result, replay.trials[simulated].result) &&
        recorded.channelBroken == replay.trials[simulated].channelBroken) {
      ++simulated;
      continue;
    }
    ++simulated;
    ++replay.trialsThatDiffer;
    if (replay.firstDifference.empty()) replay.firstDifference = fmt::format("trial {}: the result differs", recorded.trial);
  }
}

/// The stages of a recorded tick. Its watch has judged the samples already, and nobody gets the forces.
struct RecordedTicks : haptics::NoStages {
  RecordedTicks(const RunLog& theLog, const ReplayHooks& theHooks, const haptics::TickEngine& theEngine)
      : log(theLog), hooks(theHooks), engine(theEngine), ticks(log.ticks()), furtherHands(log.otherTicks()), setups(log.setups()),
        rows(log.allRows()), simulated(rows.columns), tracker(log.configuration().firstTrial) {}

  bool read(haptics::TickInput& input) {
    if (replay.ticks == ticks.size()) return false;
    const RecordedTick& tick = ticks[replay.ticks];
    input.devices[0] = tick.device;
    for (std::size_t i = 0; i < furtherHands.size(); ++i) {
      if (replay.ticks >= furtherHands[i].size()) return false;
      input.devices[i + 1] = furtherHands[i][replay.ticks];
    }
    input.missedTicks = tick.missedTicks;
    input.measuredNs = tick.measuredNs;
    return true;
  }
  void command(haptics::TickInput& input) {
    input.command = ticks[replay.ticks].command;
    input.planned = {};
    if (input.command != trial::Command::NextTrial || setup == setups.size()) return;
    tracker.announce(setups[setup]);
    input.planned = setups[setup++].planned;
  }
  void publish(const haptics::TickInput&) {
    const haptics::TickState& state = engine.state();
    const RecordedTick& tick = ticks[replay.ticks];
    const std::uint64_t expected = ticks.front().tick + replay.ticks;
    if (tick.tick != expected || state.tick != tick.tick)
      throw FaultError(fileFault(
          log.path(), fmt::format("tick {} is missing (dropped while recording), so the run cannot be simulated past it", expected)));
    ++replay.ticks;
    if (row < rows.size() && rows.ticks[row] == state.tick) compareRow(state);
    if (hooks.afterTick) hooks.afterTick(state);
    if (tracker.add(tick, factsOf(state), events).finished) replay.trials.push_back(tracker.trial());
  }

  // Holds the simulated row against the recorded one.
  void compareRow(const haptics::TickState& state) {
    const ChannelTable& table = log.configuration().table;
    fillRow(table, state, simulated.data());
    numberTrial(table, log.configuration().firstTrial, simulated.data());
    const std::size_t scene = rowWidth(table);
    const bool further = hooks.further && table.size() > scene;
    if (further) hooks.further(simulated.data() + scene);
    for (std::size_t column = 0; column < (further ? table.size() : scene); ++column) {
      const double recorded = rows.at(row, column);
      if (column == kMeasuredTime || sameBits(recorded, simulated[column])) continue;
      if (replay.firstDifference.empty())
        replay.firstDifference = fmt::format("tick {}, {}: recorded {:.17g}, simulated {:.17g}", state.tick, table.channels[column].name,
                                             recorded, simulated[column]);
      ++replay.rowsThatDiffer;
      break;
    }
    ++replay.rows;
    ++row;
  }

  const RunLog& log;
  const ReplayHooks& hooks;
  const haptics::TickEngine& engine;
  std::vector<RecordedTick> ticks;
  std::vector<std::vector<haptics::DeviceSample>> furtherHands;
  std::vector<TrialSetup> setups;
  std::size_t setup = 0;
  SampleRows rows;
  std::size_t row = 0;            // of the next that is compared
  std::vector<double> simulated;  // one row
  TrialTracker tracker;
  std::vector<RecordedEvent> events;
  Replay replay;
};

}  // namespace

Replay replayRun(const RunLog& log, const ReplayHooks& hooks) {
  const RunConfiguration& c = log.configuration();
  const std::vector<experiment::CompiledExperiment> scenes = recordedScenes(c);
  const haptics::EngineOptions options{devicesOf(c)};
  const auto made = hooks.makeEngine ? hooks.makeEngine(scenes.front(), options) : std::make_unique<haptics::TickEngine>(scenes, options);
  haptics::TickEngine& engine = *made;
  experiment::Experiment recorded = channelsOfAll(scenes);
  if (hooks.makeEngine) recorded.hands.clear();  // a station's own hand alone
  const ChannelTable scene = makeChannelTable(recorded, engine.constraint().parameterCount());
  if (c.table.massCount != scene.massCount || c.table.parameterCount != scene.parameterCount || c.table.body != scene.body ||
      c.table.hands != scene.hands || c.table.environment != scene.environment || c.table.cursor != scene.cursor)
    throw FaultError(Fault{"table",
                           "has not the masses, hands, forces and cursor of its experiment, so the run cannot be simulated again",
                           {},
                           FilePlace{log.path()}});
  RecordedTicks ticks{log, hooks, engine};
  haptics::TickInput input;
  while (haptics::runTick(engine, input, ticks)) {}
  compareTrials(log, ticks.replay);
  return ticks.replay;
}

}  // namespace reachlab::record
