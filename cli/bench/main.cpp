#include "base/ending.h"
#include "base/os.h"
#include "cli/bench/run_bench.h"
#include "cli/exit_code.h"
#include "cli/standard_streams.h"
#include "base/stop_signals.h"

/// What `reach bench` starts. A program of its own, because it replaces operator new to count allocations, and the program that records
/// people runs under the system's.
int main(int argc, char** argv) {
  using namespace reachlab::cli;
  reachlab::endOnUncaught();
  reachlab::os::holdStandardDescriptors();
  guardStandardStreams();
  reachlab::endOnSignals();
  BenchOptions options;
  CLI::App app{kBenchSummary, "reach bench"};
  addBenchOptions(app, options);
  return finishStandardOutput(exitCodeOf(app, [&] {
    app.parse(argc, argv);
    runBench(options);
    return 0;
  }));
}
