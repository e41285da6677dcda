#include "analysis/counts.h"

namespace reachlab::analysis {

void countTrial(const AnalyzedTrial& trial, ConditionResult& result) {
  if (!trial.exclusion.empty()) ++result.exclusions[trial.exclusion];
  if (trial.catchTrial) {
    ++result.counts.catchTrials;
    return;
  }
  if (trial.practice) ++result.counts.practice;
  if (trial.exclusion == "practice" || trial.exclusion.starts_with("excluded")) return;
  switch (trial.result.outcome) {
    case trial::Outcome::Success: ++result.counts.success; break;
    case trial::Outcome::Failure: ++result.counts.failure; break;
    case trial::Outcome::Aborted: ++result.counts.aborted; break;
    case trial::Outcome::Interrupted: ++result.counts.interrupted; break;
    case trial::Outcome::None: break;
  }
  if (trial.result.outcome != trial::Outcome::Success && trial.result.reason != trial::Reason::None)
    ++result.reasons[std::string(nameOf(trial.result.reason))];
  if (trial.result.outcome == trial::Outcome::Interrupted && trial.result.reason == trial::Reason::Timing) ++result.counts.invalidTiming;
  if (trial.measures.beforeGo) ++result.counts.beforeGo;
  if (trial.otherWay) ++result.counts.otherWay;
}

}  // namespace reachlab::analysis
