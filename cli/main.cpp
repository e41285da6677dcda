#include <clocale>

#include "base/command_words.h"
#include "base/system/ending.h"
#include "base/system/kept_memory.h"
#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/stop_signals.h"
#include "cli/commands/adaptation_command.h"
#include "cli/commands/commands.h"
#include "cli/commands/latency_command.h"
#include "cli/commands/merge_command.h"
#include "cli/terminal/every_option.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/standard_streams.h"

namespace {

/// The program's own line of commands.
class Reach : public CLI::App {
 public:
  using CLI::App::App;
  void pre_callback() override { reachlab::cli::checkOutputs(*this); }
};

int run(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::cli;
  int exitCode = 0;
  Reach app{"reach: reaching experiments without a window", "reach"};
  app.set_version_flag("--version", "reach " REACHLAB_VERSION);
  app.require_subcommand(1);
  app.footer("Example: reach run chain-moderate --device simulated --trials 20 --seed 1 --fast");
  for (auto* add : {addListCommand,    addValidateCommand,   addRunCommand,      addSimulateCommand, addPredictCommand,
                    addAnalyzeCommand, addShowCommand,       addReplayCommand,   addExportCommand,   addBackupCommand,
                    addRecoverCommand, addConstraintCommand, addBenchCommand,    addStationCommand,  addMergeCommand,
                    addPeersCommand,   addStabilityCommand,  addVelocityCommand, addLatencyCommand,  addStudyCommand,   addAdaptationCommand})
    add(app, exitCode);
  checkEveryNumber(app);
  return exitCodeOf(app, [&] {
    refuseEmptyWords(argc, argv);
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
