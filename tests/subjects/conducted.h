#pragma once
#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "sim/haptics/run_conductor.h"
#include "sim/haptics/tick_order.h"

/// Trials that a virtual subject does on the virtual clock.
namespace reachlab::subjects {

inline std::vector<haptics::ConductedTrial> conduct(const experiment::CompiledExperiment& experiment,
                                                    std::unique_ptr<haptics::HapticDevice> hand, int trials, int first = 0) {
  haptics::LoopOptions options;
  options.virtualClock = true;
  std::vector<trial::PlannedTrial> planned;
  for (int i = 0; i < trials; ++i) planned.push_back({first + i});
  haptics::RunConductor run(experiment::CompiledExperiment(experiment), std::move(hand), planned, options);
  run.start(nullptr);
  const std::atomic<bool> stop{false};
  std::vector<haptics::ConductedTrial> results;
  while (const auto trial = run.runTrial(stop)) results.push_back(*trial);
  return results;
}

/// Does one trial of the hand on the engine, whose forces it feels and whose masses it sees. After each tick `look` gets the hand's sample
/// and its cue, if any. The trial ends by itself, or when `look` says false.
template <class Look>
void reachTickByTick(haptics::TickEngine& engine, haptics::HapticDevice& hand, Look&& look) {
  const haptics::TickState& state = engine.state();
  haptics::TickInput input;
  input.command = trial::Command::NextTrial;
  for (int tick = 0; tick < 20'000 && state.phase != trial::Phase::Done; ++tick) {
    input.devices[0] = hand.read();
    haptics::runTick(engine, input);
    input.command = trial::Command::None;
    hand.write(state.hands[0].deviceForce);
    if (const auto cue = engine.cue()) hand.cue(*cue);
    hand.see({state.masses.data(), static_cast<std::size_t>(state.massCount)});
    if (!look(input.devices[0], engine.cue())) return;
  }
}

inline int successes(const std::vector<haptics::ConductedTrial>& trials) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(),
                                        [](const haptics::ConductedTrial& t) { return t.result.outcome == trial::Outcome::Success; }));
}

}  // namespace reachlab::subjects
