#pragma once

namespace reachlab::trial {

/// One trial as it was planned before the run. The order of trials is part of the configuration.
struct PlannedTrial {
  int index = 0;            // from 0: what the device's motion and the foreperiod depend on, with the seed
  int foreperiodTicks = 0;  // [ms] between arming and the go signal; 0: go at arming
  bool catchTrial = false;  // no go signal is given: moving is the failure
  int scene = 0;            // from 0: its scene in the block, by kind and target
};

}  // namespace reachlab::trial
