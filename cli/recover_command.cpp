#include <fmt/format.h>

#include "cli/commands.h"
#include "sim/record/recover.h"

namespace reachlab {

void addRecoverCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("recover", "Mends a damaged log in place");
  const auto path = std::make_shared<std::string>();
  command->add_option("log", *path, "The log (…_log.reach)")->required();
  command->footer(
      "Everything before the first damage is kept byte for byte, a trial under way there is marked interrupted, and the log is "
      "closed.\n"
      "The log as found stays beside it (….damaged). A healthy log is left alone.\n\n"
      "Example:\n"
      "  reach recover data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach");
  command->callback([path] {
    const Recovery recovery = recoverLog(*path);
    if (!recovery.mended) {
      fmt::print("{}: healthy, {} trials, left as it is\n", *path, recovery.trials);
      return;
    }
    fmt::print("{}: mended, {} trials{}; {} bytes kept, {} bytes could not be read; the log as found is {}\n", *path, recovery.trials,
               recovery.interruptedTrial ? " (the last one interrupted)" : "", recovery.keptBytes, recovery.lostBytes,
               recovery.damagedOriginal);
  });
}

}  // namespace reachlab
