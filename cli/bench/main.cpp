#include "base/system/error_report.h"
#include "base/system/os.h"
#include "base/system/stop_signals.h"
#include "cli/bench/bench_options.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/standard_streams.h"

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
