#pragma once

namespace reachlab::experiment {

/// What a subject's own screen shows. Stored with the experiment: what is seen is part of what is asked.
struct SubjectScreen {
  bool semaphore = true, target = true, masses = true, words = true;
  bool score = false;       // trials of the run that succeeded
  bool photodiode = false;  // a square in the lower left corner, white from the go signal to the trial's end: for a light sensor
  bool operator==(const SubjectScreen&) const = default;
};

}  // namespace reachlab::experiment
