#include "analysis/report/write_analysis.h"

#include <list>

#include "analysis/hands.h"
#include "analysis/report/alternatives.h"
#include "analysis/table_columns.h"
#include "analysis/tables.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"
#include "sim/record/log/log.h"

namespace reachlab::analysis {
namespace {

/// Tables on their way to their files: taken piece by piece, put in place at the end.
class TableFiles {
 public:
  explicit TableFiles(const std::string& folder) : folder_(folder) {}
  void write(const std::string& name, std::string_view piece) {
    if (open_.empty() || open_.back().name != name) open_.emplace_back(name, folder_ + "/" + name, piece.substr(0, piece.find('\n')));
    open_.back().file.append(piece);
  }
  std::vector<std::string> close() {
    std::vector<std::string> written;
    for (Table& table : open_) {
      table.file.commit();
      const std::string path = folder_ + "/" + table.name;
      record::writeFileAtomically(record::dictionaryPathOf(path), record::columnDictionary(table.header, tableColumns(table.name)));
      written.push_back(path);
    }
    return written;
  }

 private:
  struct Table {
    Table(std::string n, const std::string& path, std::string_view line) : name(std::move(n)), header(line), file(path) {}
    std::string name, header;
    record::AtomicFile file;
  };
  std::string folder_;
  std::list<Table> open_;
};

}  // namespace

std::string analysisFolderOf(const std::string& dataset) {
  if (dataset.ends_with(record::kLogEnding)) return dataset.substr(0, dataset.size() - record::kLogEnding.size()) + "_report";
  return dataset + "/derivatives/reachlab";
}

void writeFigure(const std::string& stem, const figure::Figure& figure, std::vector<std::string>& written) {
  for (const char* ending : {".svg", ".pdf"}) {
    const std::string& file = written.emplace_back(stem + ending);
    record::writeFileAtomically(file, figure::renderFor(file, figure));
  }
}

AnalysisFiles writeAnalysis(const Analysis& analysis, const DatasetIndex& dataset, const ReportHeader& header, const std::string& folder,
                            const std::optional<TruthRecovery>& recovery) {
  AnalysisFiles files;
  const record::FolderHold hold(folder, record::FolderHold::WithoutLocks::HoldNothing);  // all that is written here belongs to one analysis
  TableFiles tables(folder);
  writeTables(analysis, [&](const std::string& name, std::string_view piece) { tables.write(name, piece); });
  if (!analysis.alternatives.empty()) tables.write("alternatives.csv", alternativesTable(analysis));
  if (recovery) tables.write("recovery.csv", recoveryTable(*recovery));
  if (const std::string hands = handsTable(dataset); !hands.empty()) tables.write("hands.csv", hands);
  files.tables = tables.close();
  const std::vector<NamedFigure> figures = makeFigures(analysis, recovery);
  for (const NamedFigure& figure : figures) writeFigure(folder + "/figures/" + figure.name, figure.figure, files.figures);
  files.report = folder + "/report.html";
  record::writeFileAtomically(files.report, makeReport(header, analysis, figures, dataset.runs, dataset.notes, recovery));
  return files;
}

}  // namespace reachlab::analysis
