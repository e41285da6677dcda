#pragma once
#include <string>
#include <vector>

#include "analysis/dataset.h"
#include "analysis/report/figures.h"

namespace reachlab::analysis {

/// The header of a report.
struct ReportHeader {
  std::string dataset, version, command;
  std::vector<std::string> plan = {};  // sentences about the analysis plan and the departures from it
};

/// One self-contained HTML page. It begins with one plain sentence, a figure, and tables of the numbers. Success and learning follow, then
/// figures and measures of each condition, the methods paragraph, limits and provenance. The page needs no network and no script, and
/// prints.
std::string makeReport(const ReportHeader& header, const Analysis& analysis, const std::vector<NamedFigure>& figures,
                       const std::vector<AnalysedRun>& runs, const std::vector<std::string>& notes,
                       const std::optional<TruthRecovery>& recovery = {});

/// Text as HTML text.
std::string escaped(const std::string& text);

}  // namespace reachlab::analysis
