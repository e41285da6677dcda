#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/output/trial_line.h"
#include "network/link/given_samples.h"
#include "network/link/station_replay.h"
#include "network/merge/station_merge.h"
#include "sim/record/replay.h"

namespace reachlab::cli {

void addReplayCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("replay", "Simulates a recorded run again from its raw inputs");
  const auto path = std::make_shared<std::string>();
  const auto check = std::make_shared<bool>(false);
  command->add_option("log", *path, "The log (…_log.reach)")->required();
  command->add_flag("--check", *check, "Are the states bit-identical to the recorded ones? Exits 1 when they differ");
  command->footer(
      "Prints one line per trial as simulated now (by in m, m/s or s). Results are bit-identical with the program that recorded, on\n"
      "every processor; another version or compiler may round differently.\n\n"
      "Example:\n"
      "  reach replay data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach --check");
  command->callback([path, check, &exitCode] {
    const record::RunLog log = record::RunLog::open(*path);
    if (!log.healthy()) fmt::print(stderr, "note: {}: not closed in order or damaged; replayed up to its last good record\n", *path);
    const auto tell = [&](const record::Replay& replay) {
      for (const record::RecordedTrial& trial : replay.trials)
        fmt::print("{}\n", trialLine(trial.trial, trial.result, record::sceneOf(log.configuration(), trial.planned)));
      fmt::print("{} ticks simulated, {} rows compared, {} differ; {} trial results differ: {}\n", replay.ticks, replay.rows,
                 replay.rowsThatDiffer, replay.trialsThatDiffer, replay.identical() ? "identical" : replay.firstDifference);
      if (*check && !replay.identical()) exitCode = 1;
    };
    if (!network::isMerged(log)) {
      tell(network::isOfStation(log) ? network::replayStation(log) : record::replayRun(log));
      return;
    }
    for (const std::string& one : network::logsOfMerged(log)) {  // a copy at each station
      fmt::print("{}:\n", one);
      tell(network::replayStation(record::RunLog::open(one)));
    }
  });
}

}  // namespace reachlab::cli
