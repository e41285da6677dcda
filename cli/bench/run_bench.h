#pragma once
#include "cli/bench/bench_options.h"

namespace reachlab::cli {

/// Carries out the benchmarks of `options` and prints the results. Throws reachlab::Error for a fault.
void runBench(const BenchOptions& options);

}  // namespace reachlab::cli
