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

/// The fastest row of a scene with a state error of at most `error`, among the rows that `wanted` accepts. Null if no row qualifies.
const Row* cheapest(const std::vector<Row>& rows, const std::string& scene, double error, const std::function<bool(const Row&)>& wanted);
bool isPeer(const Row& row);

/// The rows as text, scene by scene, and (with peers) the ratios at state errors 1e-6 and 1e-10. For a reader.
std::string formatTable(const std::vector<Row>& rows);
std::string formatRatios(const std::vector<Row>& rows);

/// Work against precision as SVG, one panel per scene: computation time along x, state error along y.
std::string drawWorkPrecision(const std::vector<Row>& rows);

}  // namespace reachlab::bench
