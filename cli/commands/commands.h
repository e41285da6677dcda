#pragma once
namespace CLI {
class App;
}

namespace reachlab::cli {

/// Parses the words and runs the command that they name. Returns the exit code.
int runReach(int argc, char** argv);

/// Adds one subcommand to `reach`. The callback throws reachlab::Error for a fault. Other exits set `exitCode`.
using AddCommand = void(CLI::App& app, int& exitCode);
AddCommand addListCommand, addValidateCommand, addRunCommand, addSimulateCommand, addPredictCommand, addAnalyzeCommand, addReplayCommand,
    addShowCommand, addExportCommand, addBackupCommand, addRecoverCommand, addConstraintCommand, addBenchCommand, addStationCommand,
    addPeersCommand, addStabilityCommand, addVelocityCommand, addStudyCommand, addAdaptationCommand, addLatencyCommand, addMergeCommand;

}  // namespace reachlab::cli
