#include <cctype>
#include <clocale>
#include <string>

#include "base/system/ending.h"
#include "base/system/kept_memory.h"
#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/stop_signals.h"
#include "cli/commands/adaptation_command.h"
#include "cli/commands/commands.h"
#include "cli/commands/latency_command.h"
#include "cli/commands/merge_command.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/standard_streams.h"

namespace {

/// No option takes "nan" or "inf" for a number: what reads like a default would be recorded.
void refuseNonFinite(CLI::App& command) {
  const CLI::Validator finite(
      [](std::string& text) {
        std::string word;
        for (const char c : text)
          if (c != '+' && c != '-') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return word.starts_with("nan") || word.starts_with("inf") ? "is " + text + "; allowed: a finite number" : std::string();
      },
      "");
  for (CLI::Option* option : command.get_options())
    if (option->get_type_name().find("FLOAT") != std::string::npos) option->check(finite);
}

int run(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::cli;
  int exitCode = 0;
  CLI::App app{"reach: reaching experiments without a window", "reach"};
  app.set_version_flag("--version", "reach " REACHLAB_VERSION);
  app.require_subcommand(1);
  app.footer("Example: reach run chain-moderate --device simulated --trials 20 --seed 1 --fast");
  for (auto* add : {addListCommand,    addValidateCommand,   addRunCommand,      addSimulateCommand, addPredictCommand,
                    addAnalyzeCommand, addShowCommand,       addReplayCommand,   addExportCommand,   addBackupCommand,
                    addRecoverCommand, addConstraintCommand, addBenchCommand,    addStationCommand,  addMergeCommand,
                    addPeersCommand,   addStabilityCommand,  addVelocityCommand, addLatencyCommand,  addStudyCommand,   addAdaptationCommand})
    add(app, exitCode);
  for (CLI::App* command : app.get_subcommands({})) refuseNonFinite(*command);
  return exitCodeOf(app, [&] {
    app.parse(argc, argv);
    return exitCode;
  });
}

}  // namespace

int main(int argc, char** argv) {
  reachlab::requireProcessorLevel();
  reachlab::endOnUncaught();
  reachlab::keepFreedMemory();
  reachlab::os::holdStandardDescriptors();
  reachlab::cli::guardStandardStreams();
  reachlab::endOnSignals();
  return reachlab::cli::finishStandardOutput(run(argc, argv));
}
