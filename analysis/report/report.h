#pragma once
#include <string>
#include <vector>

#include "analysis/dataset.h"
#include "analysis/report/figures.h"

namespace reachlab::analysis {

/// What the report says of itself.
struct ReportHeader {
  std::string dataset, version, command;
};

/// One self-contained HTML page. It leads with one plain sentence and a figure, the numbers stand in tables beneath; then success and
/// learning, condition by condition figures and measures, the methods paragraph, limits, provenance. Needs no network, no script, and
/// prints.
std::string makeReport(const ReportHeader& header, const Analysis& analysis, const std::vector<NamedFigure>& figures,
                       const std::vector<RunProvenance>& runs, const std::vector<std::string>& notes,
                       const std::optional<TruthRecovery>& recovery = {});

/// Text as HTML text.
std::string escaped(const std::string& text);

}  // namespace reachlab::analysis
