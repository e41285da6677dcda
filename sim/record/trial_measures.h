#pragma once
#include <limits>

#include "sim/record/run_log.h"

namespace reachlab::record {

/// A trial's moments in seconds since the run began; NaN: never came.
struct TrialTimes {
  double start = 0, armed = 0, go = 0, onset = 0, end = 0;
  double reaction = 0;  // [s] from the go signal to the onset
};

inline TrialTimes timesOf(const RecordedTrial& trial) {
  const auto seconds = [](std::uint64_t tick) {
    return tick == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(tick) / 1000.0;
  };
  TrialTimes t;
  t.start = static_cast<double>(trial.startTick) / 1000.0;
  t.armed = seconds(trial.armedTick);
  t.go = seconds(trial.goTick);
  t.onset = seconds(trial.result.onsetTick);
  t.end = static_cast<double>(trial.result.endTick > 0 ? trial.result.endTick : trial.lastTick) / 1000.0;
  t.reaction = trial.result.onsetTick > 0 && trial.goTick > 0
                   ? (static_cast<double>(trial.result.onsetTick) - static_cast<double>(trial.goTick)) / 1000.0
                   : std::numeric_limits<double>::quiet_NaN();
  return t;
}

/// NaN where the hand never set off.
inline double movementTimeOf(const RecordedTrial& trial) {
  return trial.result.onsetTick > 0 ? trial.result.movementTime : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace reachlab::record
