#include "sim/analyze/write_analysis.h"

#include "sim/analyze/tables.h"
#include "sim/record/append_file.h"
#include "sim/record/column_dictionary.h"

namespace reachlab::analyze {

AnalysisFiles writeAnalysis(const StudyResult& study, const Dataset& dataset, const ReportHeader& header, const std::string& folder) {
  AnalysisFiles files;
  record::makeFolders(folder + "/figures");
  for (const auto& [name, text] : makeTables(study)) {
    files.tables.push_back(folder + "/" + name);
    record::writeFileAtomically(files.tables.back(), text);
    record::writeFileAtomically(record::dictionaryPathOf(files.tables.back()), tableDictionary(name, text));
  }
  const std::vector<NamedFigure> figures = makeFigures(study);
  for (const NamedFigure& figure : figures) {
    const std::string path = folder + "/figures/" + figure.name;
    record::writeFileAtomically(path + ".svg", figure::renderSvg(figure.figure));
    record::writeFileAtomically(path + ".pdf", figure::renderPdf(figure.figure));
    files.figures.push_back(path + ".svg");
    files.figures.push_back(path + ".pdf");
  }
  files.report = folder + "/report.html";
  record::writeFileAtomically(files.report, makeReport(header, study, figures, dataset.runs, dataset.notes));
  return files;
}

}  // namespace reachlab::analyze
