#include "cli/commands/commands.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "network/merge/station_merge.h"
#include "sim/record/export/exporters.h"
#include "sim/record/log/folder_hold.h"
#include "sim/session/session_folder.h"

namespace reachlab::cli {
namespace {

struct MergeOptions {
  std::vector<std::string> logs;
  std::string data = "./data", subject, session;
};

void merge(const MergeOptions& o) {
  record::RunConfiguration c = record::RunLog::open(o.logs.at(0), record::LogCheck::Trials).configuration();
  if (!o.subject.empty()) c.subject = o.subject;
  if (!o.session.empty()) c.session = o.session;
  record::checkConfiguration(c);
  const session::SessionPlace place{o.data, c.subject, c.session};
  const record::FolderHold hold = session::holdDataset(o.data);
  c.run = session::chooseRun(place, std::nullopt);
  const std::string path = session::logPath(place, c.task, c.run);
  const network::MergeReport report = network::mergeStations(o.logs, c, path);
  for (const network::MergedStation& s : report.stations)
    fmt::print(
        "station={}{} ticks={} samples={} replay=identical other_outcomes={} clock_offset_s={:.6f} clock_spread_s={:.6f} apart_rms_m={:.6g}\n",
        s.station, s.conductor ? " conductor" : "", s.ticks, s.samples, s.otherOutcomes, s.offset, s.offsetSpread, s.apart);
  const std::vector<record::RunLog> run{record::RunLog::open(path)};
  for (const record::Exporter& exporter : record::exporters())
    if (exporter.withEachRun) record::writeInto(o.data, exporter, run);
  if (report.cutOff > 0)
    fmt::print(stderr,
               "warning: the merged run ends where the log of a station ends, and {} trial{} of the conductor {} left out or interrupted\n",
               report.cutOff, report.cutOff == 1 ? "" : "s", report.cutOff == 1 ? "is" : "are");
  fmt::print("{}: {} trials, {} rows\n", path, report.trials, report.rows);
}

}  // namespace

void addMergeCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("merge", "Makes one dataset of the logs that several stations recorded of one run");
  const auto o = std::make_shared<MergeOptions>();
  command->add_option("logs", o->logs, "The stations' logs (…_log.reach), one of each")->required()->expected(2, 8);
  command->add_option("--data", o->data, "Folder of the merged dataset")->capture_default_str();
  command->add_option("--subject", o->subject, "Subject's label there [default: the first log's]");
  command->add_option("--session", o->session, "Session's label there [default: the first log's]");
  command->footer(
      "The merged run has the conductor's ticks, object and outcomes, and of every station its hand at the same moment; clocks are "
      "compared by what\n"
      "the stations sent each other. Refused: stations missing or twice, other experiments, clocks that contradict each other, a log whose "
      "copy of the\n"
      "object is another when it is computed again. The stations' own logs are kept in sourcedata/stations (reach replay --check of the "
      "merged\n"
      "log computes each again); what every copy was to every other station (distance, age, fade, synchronisation, round trip, loss, "
      "ledger) are\n"
      "channels of the merged recording.\n\n"
      "Example:\n"
      "  reach merge left/sourcedata/*_log.reach right/sourcedata/*_log.reach --data together");
  command->callback([o] { merge(*o); });
}

}  // namespace reachlab::cli
