#include "sim/analyze/counts.h"

#include <map>
#include <tuple>

namespace reachlab::analyze {

void countTrial(const TrialData& data, const StudyTrial& trial, std::size_t conditions, std::vector<ConditionResult>& results) {
  results.resize(conditions);
  ConditionResult& result = results.at(trial.condition);
  if (!trial.exclusion.empty()) ++result.exclusions[trial.exclusion];
  if (data.catchTrial) {
    ++result.counts.catchTrials;
    return;
  }
  if (data.practice) ++result.counts.practice;
  if (trial.exclusion == "practice") return;
  switch (data.result.outcome) {
    case trial::Outcome::Success: ++result.counts.success; break;
    case trial::Outcome::Failure: ++result.counts.failure; break;
    case trial::Outcome::Aborted: ++result.counts.aborted; break;
    case trial::Outcome::Interrupted: ++result.counts.interrupted; break;
    case trial::Outcome::None: break;
  }
  if (data.result.outcome != trial::Outcome::Success && data.result.reason != trial::Reason::None)
    ++result.reasons[std::string(trial::nameOf(data.result.reason))];
}

std::vector<SuccessCell> successTable(const std::vector<StudyTrial>& trials) {
  std::map<std::tuple<std::string, std::size_t, int>, SuccessCell> cells;
  for (const StudyTrial& trial : trials) {
    if (!trial.counted) continue;
    SuccessCell& cell = cells[{trial.key.subject, trial.condition, trial.key.day}];
    cell.subject = trial.key.subject;
    cell.day = trial.key.day;
    cell.condition = trial.condition;
    ++cell.trials;
    if (trial.result.outcome == trial::Outcome::Success) ++cell.successes;
  }
  std::vector<SuccessCell> out;
  for (auto& [key, cell] : cells) {
    cell.interval = computeWilsonInterval(cell.successes, cell.trials);
    out.push_back(cell);
  }
  return out;
}

std::vector<LearningPoint> learningCurves(const std::vector<StudyTrial>& trials, int bin) {
  std::vector<LearningPoint> out;
  const auto close = [](LearningPoint& point) { point.interval = computeWilsonInterval(point.successes, point.trials); };
  int counted = 0;
  for (const StudyTrial& trial : trials) {
    if (!trial.counted) continue;
    const bool sameSubject = !out.empty() && out.back().subject == trial.key.subject && out.back().condition == trial.condition;
    if (!sameSubject) counted = 0;
    ++counted;
    const bool open = sameSubject && out.back().session == trial.key.session && out.back().trials < static_cast<std::size_t>(bin);
    if (!open) {
      if (!out.empty()) close(out.back());
      out.push_back({trial.key.subject, trial.key.session, trial.condition, counted, counted, 0, 0, {}});
    }
    LearningPoint& point = out.back();
    point.lastTrial = counted;
    ++point.trials;
    if (trial.result.outcome == trial::Outcome::Success) ++point.successes;
  }
  if (!out.empty()) close(out.back());
  return out;
}

}  // namespace reachlab::analyze
