#pragma once
#include <string>
#include <vector>

#include "analysis/dataset.h"
#include "analysis/report/report.h"

namespace reachlab::analysis {

/// The folder that an analysis is written to: one in the dataset, or one beside a single log.
std::string analysisFolderOf(const std::string& dataset);

/// Writes `stem`.svg and `stem`.pdf, and adds both to `written`.
void writeFigure(const std::string& stem, const figure::Figure& figure, std::vector<std::string>& written);

struct AnalysisFiles {
  std::string report;
  std::vector<std::string> tables, figures;
};

/// Writes tables, figures and report.html into `folder`. Tables are CSV, each with the dictionary of its columns as JSON. Figures are SVG
/// and PDF in figures/. Each file is replaced in one step. The same study gives the same bytes. Throws ResourceError.
AnalysisFiles writeAnalysis(const Analysis& analysis, const DatasetIndex& dataset, const ReportHeader& header, const std::string& folder,
                            const std::optional<TruthRecovery>& recovery = {});

}  // namespace reachlab::analysis
