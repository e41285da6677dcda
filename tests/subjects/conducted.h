#pragma once
#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "sim/haptics/run_conductor.h"

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

inline int successes(const std::vector<haptics::ConductedTrial>& trials) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(),
                                        [](const haptics::ConductedTrial& t) { return t.result.outcome == trial::Outcome::Success; }));
}

}  // namespace reachlab::subjects
