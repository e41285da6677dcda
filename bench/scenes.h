#pragma once
#include <string>
#include <vector>

#include "bench/scene_hand.h"
#include "sim/experiment/experiment.h"

namespace reachlab::bench {

/// One scene on which speed is compared with error: an experiment, the hand as a function of time, and the start of the masses.
struct BenchScene {
  std::string name;   // S1 … S8
  std::string title;  // a description of one line
  experiment::Experiment experiment;
  SceneHand hand;                   // kind None: nobody holds the object
  double duration = 1.35;           // [s]
  std::vector<double> start, rate;  // common constraint parameters and rates of all masses; rate empty: at rest
  bool cartesian = false;           // the path passes a pole, where the chart has no coordinates: the state is r and v
};

/// All scenes in the order of the table.
std::vector<BenchScene> benchScenes();
/// The scene of this name. Throws FaultError with the allowed names.
BenchScene benchScene(const std::string& name);

}  // namespace reachlab::bench
