#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.h"

namespace reachlab::analysis {

/// Takes a piece of the file of that name. The pieces of a file come in order.
using TableWriter = std::function<void(const std::string& name, std::string_view piece)>;

/// Names the rows over all conditions, or over all blocks.
inline constexpr const char* kAllTogether = "all";

/// The analysis as tidy CSV files, with the columns of tableColumns. Every number of a figure or of the report is in a table. Numbers
/// read back equal. An empty cell is a value that could not be measured.
void writeTables(const Analysis& analysis, const TableWriter& write);

/// One row of fits.csv, and of `fits` in JSON. `person` and `fit` are parts of the analysis, which must live as long as the row.
struct FitRow {
  const PersonResult* person = nullptr;
  const CandidateFit* fit = nullptr;
  std::string condition, criterion;
  std::vector<std::string> equivalent;
  std::optional<double> plan;  // [s]
  std::string timeLaw;
  std::optional<double> handMass;  // [kg]
  double misfit = 0;               // score less that of the person's own mean
  std::string toward;              // of the person's closest candidate: see Conclusion::mixedWith. Empty for the others
  double towardShare = 0, towardP = 1;
  bool decided = false;
};
std::vector<FitRow> fitRows(const Analysis& analysis);

/// A prediction as it is, neither cut nor stretched: velocities at equal steps from its beginning to T. As for trials, time is counted from
/// the onset that the onset rule finds.
struct PredictedCurve {
  std::vector<double> time, hand, object;  // [s], [m/s]
};
PredictedCurve curveOf(const PredictedSignal& signal);

/// "(1) min-hand-jerk", with the paper's number. "(3h)" is the literal hand-crackle variant.
std::string numberedName(predict::Criterion criterion);
/// A candidate in one word: its first criterion, or "reference".
std::string nameOfCandidate(const std::vector<predict::Criterion>& criteria);
/// A name with underscores, for columns.
std::string underscored(std::string_view name);
/// A condition's name as part of a file name: letters, digits and dashes.
std::string fileNameOf(const std::string& condition);

}  // namespace reachlab::analysis
