#pragma once
#include <optional>
#include <string>

#include "analysis/analysis.h"
#include "analysis/dataset.h"
#include "analysis/recovery.h"
#include "analysis/report/write_analysis.h"
#include "cli/terminal/analysis_plan.h"

namespace reachlab::cli {

/// The text of `reach analyze --json`: written files, conclusions, fits, effects and learning by condition.
std::string summaryJson(const analysis::Analysis& analysis, const analysis::DatasetIndex& dataset, const analysis::AnalysisFiles& files,
                        const std::optional<analysis::TruthRecovery>& recovery, const std::optional<AnalysisPlan>& plan);

}  // namespace reachlab::cli
