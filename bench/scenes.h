#pragma once
#include <string>
#include <vector>

#include "bench/hand_law.h"
#include "sim/experiment/experiment.h"

namespace reachlab::bench {

/// One scene on which speed is set against error: an experiment, the hand as a function of time, and where the masses begin.
struct BenchScene {
  std::string name;   // S1 … S8
  std::string title;  // what it is, in a line
  experiment::Experiment experiment;
  HandLaw hand;                     // kind None: nobody holds the object
  double duration = 1.35;           // [s]
  std::vector<double> start, rate;  // common constraint parameters and rates of all masses; rate empty: at rest
  bool cartesian = false;           // the path passes a pole, where the chart's own numbers say nothing: state = r and v
};

/// All of them, in the table's order.
std::vector<BenchScene> benchScenes();
/// One by name. Throws FaultError naming the allowed ones.
BenchScene benchScene(const std::string& name);

}  // namespace reachlab::bench
