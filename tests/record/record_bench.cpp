// Measures the recorder and the opening of sessions, and writes logs of known content for other checks.
//
//   record_bench rate [SECONDS]              1 kHz x 50 masses, every tick sampled: processor share of the recorder's thread
//   record_bench open [TRIALS...]            list the outcomes of a session and read one profile of each trial
//   record_bench log FILE TRIALS SUBJECT SESSION RUN   a log of known content
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void measureRate(double seconds) {
  const TemporaryFolder folder;
  RunConfiguration configuration = madeConfiguration(50);
  configuration.sampleEveryTicks = 1;
  Recorder recorder(folder / "rate_log.reach", configuration);
  MadeRun run(50);
  std::uint64_t dropped = 0;
  const auto start = Clock::now();
  const auto ticks = static_cast<int>(seconds * 1000);
  for (int tick = 0; tick < ticks; ++tick) {
    if (!recorder.onTick(run.next(), trial::Command::None, 0)) ++dropped;
    std::this_thread::sleep_until(start + std::chrono::milliseconds(tick + 1));
  }
  const double passed = secondsSince(start);
  const double used = recorder.processorSeconds();
  recorder.close();
  const auto bytes = static_cast<double>(std::filesystem::file_size(folder / "rate_log.reach"));
  fmt::print("1 kHz x 50 masses, {} channels, every tick: {:.2f} % of a core, {:.2f} MB/s, {} of {} ticks dropped\n",
             configuration.table.size(), 100 * used / passed, bytes / passed / 1e6, dropped, ticks);
}

// A session of blocks of 100 trials.
void measureOpening(int trials) {
  const TemporaryFolder folder;
  const int perRun = std::min(trials, 100);
  for (int run = 0; run < trials / perRun; ++run)
    writeMadeRun(folder / fmt::format("sub-01_ses-01_task-made_run-{:03}_log.reach", run + 1), perRun);
  for (const bool warm : {false, true}) {
    auto start = Clock::now();
    std::size_t successes = 0, listed = 0;
    std::vector<RunLog> runs;
    for (const std::string& path : findLogs(folder / "")) runs.push_back(RunLog::open(path, LogCheck::Trials));
    for (const RunLog& run : runs)
      for (const RecordedTrial& trial : run.trials()) ++listed, successes += trial.result.outcome == trial::Outcome::Success;
    const double listing = secondsSince(start);
    start = Clock::now();
    double sum = 0;
    for (const RunLog& run : runs)
      for (const RecordedTrial& trial : run.trials()) sum += run.rows(trial).at(0, 2);
    if (warm)
      fmt::print("{} trials ({} successes): outcomes in {:.1f} ms, a profile of each in {:.1f} ms{}\n", listed, successes, 1e3 * listing,
                 1e3 * secondsSince(start), std::isfinite(sum) ? "" : " (not finite)");
  }
}

}  // namespace
}  // namespace reachlab::record

int main(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::record;
  const std::string mode = argc > 1 ? argv[1] : "";
  if (mode == "rate") {
    measureRate(argc > 2 ? std::atof(argv[2]) : 10);
  } else if (mode == "open") {
    std::vector<int> sizes;
    for (int i = 2; i < argc; ++i) sizes.push_back(std::atoi(argv[i]));
    if (sizes.empty()) sizes = {100, 1000, 10000};
    for (const int trials : sizes) measureOpening(trials);
  } else if (mode == "log" && argc == 7) {
    RunConfiguration configuration = madeConfiguration();
    configuration.subject = argv[4];
    configuration.session = argv[5];
    configuration.run = std::atoi(argv[6]);
    writeMadeRun(argv[2], std::atoi(argv[3]), configuration);
  } else {
    fmt::print(stderr, "usage: record_bench rate [SECONDS] | open [TRIALS...] | log FILE TRIALS SUBJECT SESSION RUN\n");
    return 2;
  }
}
