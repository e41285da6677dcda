#pragma once
#include <functional>

#include "bench/measure.h"

namespace reachlab::bench {

/// The extent of a run of the bench.
struct SuiteOptions {
  std::vector<std::string> scenes;   // empty: all
  std::vector<std::string> methods;  // empty: all of ours, and the peers if built; a peer may be named too
  Effort effort;
  bool quick = false;  // only 1 ms and the default tolerance, no scan
};

/// Runs all scenes x methods x step sizes or tolerances. `progress` gets a line when a scene begins. `refusals` gets a line with the reason
/// for each method that cannot compute a scene. Throws FaultError for a scene or method that does not exist.
std::vector<Row> runSuite(const SuiteOptions& options, const std::function<void(const std::string&)>& progress,
                          std::vector<std::string>& refusals);

bool isPeer(const Row& row);

}  // namespace reachlab::bench
