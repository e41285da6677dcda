#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/fault.h"
#include "base/terminal/message.h"
#include "cli/commands/commands.h"
#include "sim/record/recover.h"

namespace reachlab::cli {

namespace {

void recover(const std::string& path) {
  const record::Recovery recovery = record::recoverLog(path);
  if (!recovery.mended) {
    fmt::print("{}: healthy, {} trials, left as it is\n", path, recovery.trials);
    return;
  }
  fmt::print("{}: repaired, {} trials{}; {} bytes kept, {} bytes could not be read; the log as found is {}\n", path, recovery.trials,
             recovery.interruptedTrial ? " (the last one interrupted)" : "", recovery.keptBytes, recovery.lostBytes,
             recovery.damagedOriginal);
}

}  // namespace

void addRecoverCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("recover", "Repairs damaged logs in place");
  const auto paths = std::make_shared<std::vector<std::string>>();
  command->add_option("log", *paths, "The logs (…_log.reach)")->required();
  command->footer(
      "Everything before the first damage is kept byte for byte, a trial under way there is marked interrupted, and the log is "
      "closed.\n"
      "The log as found stays beside it (….damaged). A healthy log is left alone. If a log cannot be repaired, the other "
      "logs are repaired all the same.\n\n"
      "Examples:\n"
      "  reach recover data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach\n"
      "  reach recover data/sourcedata/*_log.reach");
  command->callback([paths, &exitCode] {
    const auto failed = [&](const Error& fault, int code) {
      fmt::print(stderr, "{}", messageOf(std::string(fault.what())));
      exitCode = std::max(exitCode, code);
    };
    for (const std::string& path : *paths) {
      try {
        recover(path);
      } catch (const FaultError& fault) {
        failed(fault, 2);
      } catch (const ResourceError& fault) {
        failed(fault, 3);
      }
    }
  });
}

}  // namespace reachlab::cli
