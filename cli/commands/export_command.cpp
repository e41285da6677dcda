#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>

#include "cli/terminal/at_option.h"
#include "cli/commands/commands.h"
#include "cli/output/readable_logs.h"
#include "sim/record/export/exporters.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/logs_folder.h"
#include "sim/session/session_folder.h"

namespace reachlab::cli {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string what, format, out;
};

// The dataset that a log lies in (…/sourcedata/x_log.reach), else the log's own folder.
fs::path datasetOf(const std::string& log) {
  const fs::path folder = fs::absolute(log).lexically_normal().parent_path();
  return folder.filename() == record::kLogsFolder ? folder.parent_path() : folder;
}

// Files are named by the labels in the logs: of two logs with the same labels one would be written over the other.
void requireOwnNames(const std::vector<record::RunLog>& runs) {
  std::map<std::string, std::string> paths;
  for (const record::RunLog& run : runs)
    if (const auto [known, fresh] = paths.emplace(record::runName(run.configuration()), run.path()); !fresh)
      throw FaultError(Fault{{},
                             fmt::format("{} and {} are both recorded as {}", known->second, run.path(), known->first),
                             "logs of different runs. A log keeps its labels when its file is renamed. --out exports each by itself"});
}

void exportLogs(const ExportOptions& options) {
  const ReadableLogs logs = openReadableLogs(options.what, OpenLogs::LeaveOut);
  for (const std::string& path : logs.open) fmt::print(stderr, "{}: is being recorded into; left out\n", path);
  for (const record::RunLog& run : logs.runs)
    if (run.goodBytes() < run.fileBytes())
      fmt::print(stderr, "{}: damaged after byte {} of {}: read up to there ({} trials)\n", run.path(), run.goodBytes(), run.fileBytes(),
                 run.trials().size());
  requireOwnNames(logs.runs);
  const fs::path dataset = datasetOf(logs.runs.front().path());
  std::vector<std::string> written;
  atOption("--out", [&] {
    const record::Exporter& exporter = *record::findExporter(options.format);
    std::optional<record::FolderHold> hold;  // a run that ends meanwhile writes the same tables
    std::error_code error;
    const fs::path folder = options.out.empty() ? dataset : fs::path(options.out);
    if (exporter.withEachRun && fs::is_directory(folder / record::kLogsFolder, error)) hold.emplace(session::holdDataset(folder.string()));
    written = options.out.empty() ? record::writeInto(dataset.string(), exporter, logs.runs) : exporter.write(logs.runs, options.out);
  });
  for (const std::string& path : written) fmt::print("{}\n", path);
  logs.tellUnreadable();
}

}  // namespace

void addExportCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("export", "Writes recorded runs in formats that other programs read");
  const auto options = std::make_shared<ExportOptions>();
  std::string formats;
  std::vector<std::string> names;
  for (const record::Exporter& exporter : record::exporters()) {
    names.emplace_back(exporter.name);
    formats += fmt::format("{}{}: {}", formats.empty() ? "" : "; ", exporter.name, exporter.description);
  }
  command->add_option("what", options->what, "A log (…_log.reach), a session's folder (data/sub-01/ses-01), or a dataset")->required();
  command->add_option("--format", options->format, formats)->required()->check(CLI::IsMember(names));
  command->add_option("--out", options->out,
                      "Folder to write into [default: the dataset itself (bids), its derivatives/FORMAT (the others)]");
  command->footer(
      "Columns carry their units (movement_time_s, mass1_x_m, …); docs/recording.md lists them. A damaged log is read up to the "
      "damage.\n"
      "The files written are named on stdout; docs/exports.md tells what is in each and how to read it.\n\n"
      "Examples:\n"
      "  reach export data/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach --format csv --out tables\n"
      "  reach export data/sub-01/ses-01 --format csv --out tables\n"
      "  reach export data --format mat\n"
      "  reach export data --format bids");
  command->callback([options] { exportLogs(*options); });
}

}  // namespace reachlab::cli
