#include "sim/record/export/tidy_csv.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>
#include <set>

#include "base/csv_table.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/trial_row.h"

namespace reachlab::record {

experiment::Task taskOf(const RunConfiguration& configuration, const trial::PlannedTrial& planned) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  experiment::Task unknown;
  unknown.duration = kUnknown;
  unknown.tolerance = {kUnknown, kUnknown, kUnknown};
  try {
    return recordedValues(configuration, planned).task.value_or(unknown);
  } catch (const std::runtime_error&) {
    return unknown;
  }
}

std::string unitOf(trial::Reason reason) {
  switch (reason) {
    case trial::Reason::Via:
    case trial::Reason::Position: return "m";
    case trial::Reason::Velocity: return "m/s";
    case trial::Reason::TimeShort: return "s";
    default: return "";
  }
}

std::string runName(const RunConfiguration& c, const std::string& between) {
  return fmt::format("sub-{}_ses-{}_task-{}_{}run-{:02}", c.subject, c.session, c.task, between, c.run);
}

void writeRows(const RunLog& run, std::span<const std::size_t> columns, TableText table, const TakePiece& take) {
  const ExportClock clock(run);
  run.eachBlock([&](const SampleRows& block) {
    for (std::size_t row = 0; row < block.size(); ++row) {
      for (const std::size_t column : columns) table.number(clock.cell(block, row, column));
      table.endRow();
    }
    take(table.takeText());
  });
}

void trialsCsv(const std::vector<RunLog>& runs, const TakePiece& take) {
  TableText table(',', "");
  table.row(trialColumnNames());
  for (const RunLog& run : runs)
    eachTrial(run, [&](std::span<const TrialCell> cells) {
      addTrial(table, cells);
      take(table.takeText());
    });
  take(table.takeText());
}

void samplesCsv(const RunLog& run, const TakePiece& take) {
  TableText table(',', "");
  for (const Channel& channel : run.configuration().table.channels) table.cell(channel.column);
  table.endRow();
  take(table.takeText());
  std::vector<std::size_t> all(run.configuration().table.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  writeRows(run, all, std::move(table), take);
}

namespace {

/// An export replaces trials.csv by the trials of the exported runs. Rows of any other run would be lost, so they are refused.
void requireNoOtherRun(const std::vector<RunLog>& runs, const std::string& file) {
  if (!isThere(file)) return;
  const auto nameOf = [](const auto& subject, const auto& session, const auto& run) {
    return fmt::format("sub-{}, ses-{}, run {}", subject, session, run);
  };
  std::set<std::string> exported;
  for (const RunLog& run : runs) {
    const RunConfiguration& c = run.configuration();
    exported.insert(nameOf(c.subject, c.session, c.run));
  }
  const CsvTable old = readCsvTable(file);
  const auto subject = old.find("subject"), session = old.find("session"), run = old.find("run");
  if (!subject || !session || !run) return;
  for (const CsvTable::Row& row : old.rows)
    if (const std::string name = nameOf(row.cells[*subject], row.cells[*session], row.cells[*run]); !exported.contains(name))
      throw FaultError(fileFault(file, fmt::format("has trials of {}, which is not exported now", name),
                                 "an export of all runs together, or another folder. Delete the table to make it anew"));
}

}  // namespace

std::vector<std::string> writeTidyCsv(const std::vector<RunLog>& runs, const std::string& folder) {
  requireNoOtherRun(runs, folder + "/trials.csv");
  std::vector<std::string> written;
  // The table, and beside it its dictionary, which asks for the table's first line.
  const auto write = [&](const std::string& name, const auto& writer, const auto& dictionaryOf) {
    std::string header;
    AtomicFile table(written.emplace_back(fmt::format("{}/{}", folder, name)));
    writer([&](std::string_view piece) {
      if (header.empty()) header = piece.substr(0, piece.find('\n'));
      table.append(piece);
    });
    table.commit();
    writeFileAtomically(written.emplace_back(fmt::format("{}/{}", folder, dictionaryPathOf(name))), dictionaryOf(header));
  };
  for (const RunLog& run : runs)
    write(
        runName(run.configuration()) + "_samples.csv", [&](const TakePiece& take) { samplesCsv(run, take); },
        [&](const std::string& header) { return samplesDictionary(run, header); });
  write(
      "trials.csv", [&](const TakePiece& take) { trialsCsv(runs, take); }, trialsDictionary);
  return written;
}

}  // namespace reachlab::record
