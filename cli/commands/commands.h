#pragma once
namespace CLI {
class App;
}

namespace reachlab::cli {

/// Parses the words and runs the command that they name. Returns the exit code.
int runReach(int argc, char** argv);

/// Each adds one subcommand to `reach`. The callback throws reachlab::Error for a fault. Other exits set `exitCode`.
void addListCommand(CLI::App& app, int& exitCode);
void addValidateCommand(CLI::App& app, int& exitCode);
void addRunCommand(CLI::App& app, int& exitCode);
void addSimulateCommand(CLI::App& app, int& exitCode);
void addPredictCommand(CLI::App& app, int& exitCode);
void addAnalyzeCommand(CLI::App& app, int& exitCode);
void addReplayCommand(CLI::App& app, int& exitCode);
void addShowCommand(CLI::App& app, int& exitCode);
void addExportCommand(CLI::App& app, int& exitCode);
void addBackupCommand(CLI::App& app, int& exitCode);
void addRecoverCommand(CLI::App& app, int& exitCode);
void addConstraintCommand(CLI::App& app, int& exitCode);
void addBenchCommand(CLI::App& app, int& exitCode);
void addStationCommand(CLI::App& app, int& exitCode);
void addPeersCommand(CLI::App& app, int& exitCode);
void addStabilityCommand(CLI::App& app, int& exitCode);
void addVelocityCommand(CLI::App& app, int& exitCode);
void addStudyCommand(CLI::App& app, int& exitCode);
void addAdaptationCommand(CLI::App& app, int& exitCode);
void addLatencyCommand(CLI::App& app, int& exitCode);
void addMergeCommand(CLI::App& app, int& exitCode);

}  // namespace reachlab::cli
