#include "cli/output/success_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace reachlab::cli {

void SuccessTable::add(const std::string& condition, const trial::TrialResult& result) {
  auto row = std::find_if(rows_.begin(), rows_.end(), [&](const auto& r) { return r.first == condition; });
  if (row == rows_.end()) row = rows_.insert(rows_.end(), {condition, {}});
  OutcomeCounts& counts = row->second;
  ++counts.trials;
  counts.success += result.outcome == trial::Outcome::Success;
  counts.failure += result.outcome == trial::Outcome::Failure;
  counts.aborted += result.outcome == trial::Outcome::Aborted;
  counts.interrupted += result.outcome == trial::Outcome::Interrupted;
  if (result.outcome != trial::Outcome::Success) ++counts.reasons[std::string(trial::nameOf(result.reason))];
}

std::string SuccessTable::text() const {
  if (rows_.empty()) return {};
  std::size_t width = 9;
  for (const auto& row : rows_) width = std::max(width, row.first.size());
  std::string text = fmt::format("{:<{}}  {:>6}  {:>7}  {:>7}  {:>7}  {:>11}  {:>15}  {}\n", "condition", width, "trials", "success",
                                 "failure", "aborted", "interrupted", "success_percent", "reasons");
  for (const auto& [condition, c] : rows_) {
    std::string reasons;
    for (const auto& [reason, count] : c.reasons) reasons += fmt::format("{}{}={}", reasons.empty() ? "" : ",", reason, count);
    const int attempts = c.success + c.failure;  // a trial that was broken off is none
    const std::string percent = attempts > 0 ? fmt::format("{:.1f}", 100.0 * c.success / attempts) : "-";
    text += fmt::format("{:<{}}  {:>6}  {:>7}  {:>7}  {:>7}  {:>11}  {:>15}  {}\n", condition, width, c.trials, c.success, c.failure,
                        c.aborted, c.interrupted, percent, reasons.empty() ? "-" : reasons);
  }
  return text;
}

}  // namespace reachlab::cli
