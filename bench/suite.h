#pragma once
#include <functional>

#include "bench/measure.h"

namespace reachlab::bench {

/// What a run of the bench covers.
struct SuiteOptions {
  std::vector<std::string> scenes;   // empty: all
  std::vector<std::string> methods;  // empty: all of ours, and the peers if built; a peer may be named too
  Effort effort;
  bool quick = false;  // only 1 ms and the default tolerance, no scan
};

/// Our methods by name, `auto` first.
const std::vector<std::string>& methodNames();

/// Runs it: all scenes x methods x step sizes or tolerances. `progress` gets a line as a scene is begun; `refusals` one for each
/// method that a scene is not for, and why.
/// Throws FaultError for a scene or method that does not exist.
std::vector<Row> runSuite(const SuiteOptions& options, const std::function<void(const std::string&)>& progress,
                          std::vector<std::string>& refusals);

/// The cheapest row of a scene whose state error does not exceed `error`, among those that `wanted` lets through; null if none.
const Row* cheapest(const std::vector<Row>& rows, const std::string& scene, double error, const std::function<bool(const Row&)>& wanted);
bool isPeer(const Row& row);

/// The rows as text, a scene at a time, and (with peers) the ratios at state errors 1e-6 and 1e-10. For a person.
std::string formatTable(const std::vector<Row>& rows);
std::string formatRatios(const std::vector<Row>& rows);

/// Work against precision, a panel a scene, as SVG: price along x, state error along y.
std::string drawWorkPrecision(const std::vector<Row>& rows);

}  // namespace reachlab::bench
