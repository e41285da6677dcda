#pragma once
#include <limits>

#include "base/ticks.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A trial's moments in seconds since the run began; NaN: never came.
struct TrialTimes {
  double start = 0, armed = 0, go = 0, onset = 0, end = 0;
  double reaction = 0;  // [s] from the go signal to the onset
};

inline TrialTimes timesOf(const RecordedTrial& trial) {
  const auto seconds = [](std::uint64_t tick) { return tick == 0 ? std::numeric_limits<double>::quiet_NaN() : secondsOf(tick); };
  TrialTimes t;
  t.start = secondsOf(trial.startTick);
  t.armed = seconds(trial.armedTick);
  t.go = seconds(trial.goTick);
  t.onset = seconds(trial.result.onsetTick);
  t.end = secondsOf(trial.result.endTick > 0 ? trial.result.endTick : trial.lastTick);
  t.reaction = trial.result.onsetTick > 0 && trial.goTick > 0 ? secondsBetween(trial.goTick, trial.result.onsetTick)
                                                              : std::numeric_limits<double>::quiet_NaN();
  return t;
}

/// NaN where the hand never set off.
inline double movementTimeOf(const RecordedTrial& trial) {
  return trial.result.onsetTick > 0 ? trial.result.movementTime : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace reachlab::record
