#pragma once
#include "cli/bench/bench_options.h"

namespace reachlab::cli {

/// Measures and prints what `options` asks for. Throws reachlab::Error for a fault.
void runBench(const BenchOptions& options);

}  // namespace reachlab::cli
