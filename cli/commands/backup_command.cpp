#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/terminal/message.h"
#include "cli/commands/commands.h"
#include "sim/session/backup.h"

namespace reachlab::cli {
namespace {

struct BackupOptions {
  std::string dataset, backup;
  bool check = false;
};

void tellCopied(const BackupOptions& o, const session::BackupReport& report) {
  if (report.runs == 0 && report.pending == 0)
    throw FaultError(fileFault(o.dataset, "has no recorded run", "the data folder of `reach run`"));
  fmt::print("{}: all {} finished runs are there; {} files, {} bytes copied now and read back equal{}\n", o.backup, report.runs,
             report.copiedFiles, report.copiedBytes, report.pending > 0 ? fmt::format("; {} still being recorded", report.pending) : "");
}

void backUp(const BackupOptions& o) {
  std::string refused;
  try {
    tellCopied(o, session::backUp(o.dataset, o.backup));
  } catch (const ResourceError& error) {
    if (!o.check) throw;
    refused = error.what();  // the files that are there are checked all the same
  }
  if (!o.check) return;
  const std::vector<std::string> faults = session::faultsOfBackup(o.backup);
  for (const std::string& fault : faults) fmt::print(stderr, "{}", messageOf(fault));
  if (!faults.empty())
    refused += fmt::format("{}{}: {} of {} files are not what was copied", refused.empty() ? "" : "\n", o.backup, faults.size(),
                           session::filesOfBackup(o.backup));
  if (!refused.empty()) throw ResourceError(refused);
  fmt::print("{}: every byte of {} files is what was copied\n", o.backup, session::filesOfBackup(o.backup));
}

}  // namespace

void addBackupCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("backup", "Copies finished runs to a second data folder and verifies them");
  const auto o = std::make_shared<BackupOptions>();
  command->add_option("dataset", o->dataset, "The data folder of `reach run`")->required();
  command->add_option("backup", o->backup, "The second folder, best on another disk")->required();
  command->add_flag("--check", o->check, "Reads every byte of the backup again");
  command->footer(
      "What is there already is left; every copy is read back from the disk and its SHA-256 compared. The list is sourcedata/sha256sums.txt in the\n"
      "backup, for `sha256sum -c` from its folder. Derivatives are left out: they can be made again. `reach run --backup` does this at each run's end.\n\n"
      "Examples:\n"
      "  reach backup data /mnt/second/data\n"
      "  reach backup data /mnt/second/data --check");
  command->callback([o] { backUp(*o); });
}

}  // namespace reachlab::cli
