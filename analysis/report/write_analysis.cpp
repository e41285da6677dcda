#include "analysis/report/write_analysis.h"

#include <cstdio>
#include <fstream>
#include <map>

#include "analysis/tables.h"
#include "base/error.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/log/append_file.h"

namespace reachlab::analysis {
namespace {

/// Tables on their way to their files: written piece by piece under another name, put in place at the end.
class TableFiles {
 public:
  explicit TableFiles(const std::string& folder) : folder_(folder) {}
  void write(const std::string& name, std::string_view piece) {
    auto& [file, header] = open_[name];
    if (!file.is_open()) {
      order_.push_back(name);
      header = std::string(piece.substr(0, piece.find('\n')));
      file.open(folder_ + "/" + name + ".part", std::ios::binary | std::ios::trunc);
    }
    file.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    if (!file) fail(name);
  }
  std::vector<std::string> close() {
    std::vector<std::string> written;
    for (const std::string& name : order_) {
      auto& [file, header] = open_[name];
      const std::string path = folder_ + "/" + name;
      file.close();
      if (!file || std::rename((path + ".part").c_str(), path.c_str()) != 0) fail(name);
      record::writeFileAtomically(record::dictionaryPathOf(path), tableDictionary(name, header));
      written.push_back(path);
    }
    return written;
  }

 private:
  [[noreturn]] void fail(const std::string& name) const {
    throw ResourceError(folder_ + "/" + name + ": cannot be written; is the disk full?");
  }
  std::string folder_;
  std::vector<std::string> order_;
  std::map<std::string, std::pair<std::ofstream, std::string>> open_;
};

}  // namespace

AnalysisFiles writeAnalysis(const StudyResult& study, const DatasetIndex& dataset, const ReportHeader& header, const std::string& folder,
                            const std::optional<Recovery>& recovery) {
  AnalysisFiles files;
  record::makeFolders(folder + "/figures");
  TableFiles tables(folder);
  writeTables(study, [&](const std::string& name, std::string_view piece) { tables.write(name, piece); });
  if (recovery) tables.write("recovery.csv", recoveryTable(*recovery));
  files.tables = tables.close();
  const std::vector<NamedFigure> figures = makeFigures(study, recovery);
  for (const NamedFigure& figure : figures) {
    const std::string path = folder + "/figures/" + figure.name;
    record::writeFileAtomically(path + ".svg", figure::renderSvg(figure.figure));
    record::writeFileAtomically(path + ".pdf", figure::renderPdf(figure.figure));
    files.figures.push_back(path + ".svg");
    files.figures.push_back(path + ".pdf");
  }
  files.report = folder + "/report.html";
  record::writeFileAtomically(files.report, makeReport(header, study, figures, dataset.runs, dataset.notes, recovery));
  return files;
}

}  // namespace reachlab::analysis
