#pragma once

namespace reachlab::experiment {

/// The content of the subject's screen. It is stored with the experiment because it is part of the task.
struct SubjectScreen {
  bool semaphore = true, target = true, masses = true, words = true;
  bool score = false;       // trials of the run that succeeded
  bool photodiode = false;  // a square in the lower left corner, white from the go signal to the trial's end: for a light sensor
  bool operator==(const SubjectScreen&) const = default;
};

}  // namespace reachlab::experiment
