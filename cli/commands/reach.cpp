#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/terminal/command_words.h"
#include "base/terminal/help_format.h"
#include "cli/commands/commands.h"
#include "cli/terminal/every_option.h"
#include "cli/terminal/exit_code.h"

namespace reachlab::cli {
namespace {

/// The program's own line of commands.
class Reach : public CLI::App {
 public:
  using CLI::App::App;
  void pre_callback() override { checkOutputs(*this); }
};

/// The commands in the order of the work with them.
const std::vector<std::pair<const char*, std::vector<AddCommand*>>> kGroups{
    {"Record", {addRunCommand, addStationCommand, addBackupCommand, addRecoverCommand}},
    {"Inspect", {addShowCommand, addReplayCommand, addExportCommand, addMergeCommand}},
    {"Understand", {addPredictCommand, addAnalyzeCommand, addStudyCommand, addAdaptationCommand, addSimulateCommand}},
    {"Prepare", {addListCommand, addValidateCommand, addConstraintCommand, addStabilityCommand, addPeersCommand}},
    {"Measure", {addBenchCommand, addVelocityCommand, addLatencyCommand}}};

/// `help run` is `run --help`. Words that are no command stay as they are, so that the parser says what is meant.
void parse(CLI::App& app, std::vector<std::string> words) {
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    const CLI::App* command = &app;
    for (const std::string& word : words) {
      const std::vector<const CLI::App*> found = command->get_subcommands([&](const CLI::App* other) { return other->check_name(word); });
      command = found.empty() ? nullptr : found.front();
      if (command == nullptr) break;
    }
    if (command != nullptr) words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end());  // the parser takes words from the back
  app.parse(words);
}

}  // namespace

int runReach(int argc, char** argv) {
  int exitCode = 0;
  Reach app{"reach: reaching experiments without a window", "reach"};
  app.formatter(std::make_shared<HelpFormat>());  // before the commands, which take it over
  app.set_version_flag("--version", "reach " REACHLAB_VERSION);
  app.require_subcommand(1);
  app.footer(
      "`reach help COMMAND` explains a command, as `reach COMMAND --help` does.\n\nExample:\n  reach run chain-moderate --device simulated --trials 20 --seed 1 --fast");
  for (const auto& [group, commands] : kGroups)
    for (auto* const add : commands) {
      add(app, exitCode);
      app.get_subcommands({}).back()->group(group);
    }
  checkEveryNumber(app);
  return exitCodeOf(app, [&] {
    refuseEmptyWords(argc, argv);
    parse(app, std::vector<std::string>(argv + 1, argv + argc));
    return exitCode;
  });
}

}  // namespace reachlab::cli
