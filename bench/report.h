#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bench/measure.h"

namespace reachlab::bench {

/// The fastest row of a scene with a state error of at most `error`, among the rows that `wanted` accepts. Null if no row qualifies.
const Row* cheapest(const std::vector<Row>& rows, const std::string& scene, double error, const std::function<bool(const Row&)>& wanted);

/// The rows as text, scene by scene, and (with peers) the ratios at state errors 1e-6 and 1e-10. For a reader.
std::string formatTable(const std::vector<Row>& rows);
std::string formatRatios(const std::vector<Row>& rows);

/// Work against precision as SVG, one panel per scene: computation time along x, state error along y.
std::string drawWorkPrecision(const std::vector<Row>& rows);

}  // namespace reachlab::bench
