#include "sim/analyze/wording.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/analyze/tables.h"

namespace reachlab::analyze {
namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

std::string plural(std::size_t n, const std::string& noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

}  // namespace

std::string shortNumber(double value) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.3g}", value);
  if (text.front() == '-') text = "−" + text.substr(1);
  return text;
}

std::vector<predict::Criterion> criteriaOf(const ConditionResult& result) {
  std::vector<predict::Criterion> criteria;
  for (const PredictedProfile& p : result.predictions) criteria.push_back(p.criterion);
  return criteria;
}

std::string describeRanking(const Ranking& ranking, const std::vector<predict::Criterion>& criteria) {
  if (ranking.places.empty()) return "Nothing to rank: no successful trial, or no criterion that can be predicted here.";
  const RankedCriterion& first = ranking.places.front();
  const std::string name = numberedName(criteria[first.criterion]);
  const bool alone = ranking.places.size() == 1;
  std::string text =
      fmt::format("{} {}: ε = {} m/s [{}, {}], from {} of {}.", name, alone ? "is the only criterion compared" : "is nearest",
                  shortNumber(first.epsilon), shortNumber(first.interval.low), shortNumber(first.interval.high),
                  plural(ranking.trials, "trial"), plural(ranking.subjects, "subject"));
  if (alone) return text;
  if (ranking.trials < 2) return text + " One trial has no scatter, so nothing can be told apart.";
  std::vector<std::string> apart, equal;
  for (std::size_t i = 1; i < ranking.places.size(); ++i) {
    const RankedCriterion& p = ranking.places[i];
    const std::string difference = fmt::format("{} (+{} [{}, {}])", numberedName(criteria[p.criterion]), shortNumber(p.difference),
                                               shortNumber(p.differenceInterval.low), shortNumber(p.differenceInterval.high));
    (p.apartFromFirst ? apart : equal).push_back(difference);
  }
  if (!equal.empty())
    text += fmt::format(" It cannot be told apart from {}: the 95 % interval of the difference includes 0.", joined(equal));
  if (!apart.empty()) text += fmt::format(" Farther away, with a difference whose 95 % interval excludes 0: {}.", joined(apart));
  std::vector<std::string> pairs;
  for (const auto& [i, j] : ranking.ties)
    if (i > 0)
      pairs.push_back(numberedName(criteria[ranking.places[i].criterion]) + " from " + numberedName(criteria[ranking.places[j].criterion]));
  if (!pairs.empty()) text += fmt::format(" Behind the first, these cannot be told apart: {}.", joined(pairs));
  return text;
}

std::string describeMethods(const StudyOptions& options) {
  const OnsetOptions& onset = options.measure.onset;
  std::string rule;
  switch (onset.rule) {
    case OnsetRule::Percent:
      rule = fmt::format("where the hand's speed crosses {} % of the trial's own peak", shortNumber(onset.percent));
      break;
    case OnsetRule::Absolute: rule = fmt::format("where the hand's speed crosses {} m/s", shortNumber(onset.speed)); break;
    case OnsetRule::Task: rule = "by the task's own window (from t = 0 to the end of the trial)"; break;
  }
  const std::string filter = options.measure.cutoff > 0 ? fmt::format(
                                                              "The hand's position was differentiated and its velocity low-passed forwards "
                                                              "and backwards (Butterworth, second order, {} Hz "
                                                              "in each pass, so no delay); the simulated masses were not filtered.",
                                                              shortNumber(options.measure.cutoff))
                                                        : std::string("The hand's position was differentiated without a filter.");
  return fmt::format(
      "{} Onset and offset are {}; a movement ends with its trial at the latest, that is when every mass was inside the tolerances. "
      "Successful trials were time-scaled to the condition's mean duration, with velocities scaled so that "
      "the distance is kept. Each prediction, made for {}, went through the same filter, onset rule and scaling, and was cut where its "
      "speed had fallen to the trial's own at the end. ε is the root of the "
      "mean squared difference of velocity over all 101 samples of all trials. Intervals are 95 % percentiles of {} bootstrap "
      "resamples (seed {}); differences between criteria are taken within a resample.",
      filter, rule,
      options.predictFor == PredictionDuration::Task ? "the task's duration T"
      : options.predictFor == PredictionDuration::Moved
          ? "the duration that was moved"
          : "the task's duration T where the trials kept to it within 10 %, else for the duration that was moved",
      options.ranking.resamples, options.ranking.seed);
}

std::string describeCounts(const ConditionResult& r) {
  const std::size_t attempts = r.counts.success + r.counts.failure;
  std::string text = fmt::format("{} of {} succeeded", r.counts.success, plural(attempts, "trial"));
  if (attempts > 0) {
    const Interval i = computeWilsonInterval(r.counts.success, attempts);
    text += fmt::format(" ({:.0f} % [{:.0f}, {:.0f}])", 100.0 * static_cast<double>(r.counts.success) / static_cast<double>(attempts),
                        100 * i.low, 100 * i.high);
  }
  std::vector<std::string> rest;
  if (r.counts.aborted > 0) rest.push_back(fmt::format("{} aborted", r.counts.aborted));
  if (r.counts.interrupted > 0) rest.push_back(fmt::format("{} interrupted", r.counts.interrupted));
  if (r.counts.practice > 0) rest.push_back(plural(r.counts.practice, "practice trial"));
  if (r.counts.catchTrials > 0) rest.push_back(plural(r.counts.catchTrials, "catch trial"));
  if (!rest.empty()) text += "; besides " + joined(rest);
  std::vector<std::string> why;
  for (const auto& [reason, n] : r.reasons) why.push_back(fmt::format("{} × {}", n, reason));
  if (!why.empty()) text += ". Reasons: " + joined(why);
  return text + fmt::format(". {} in profiles and errors.", plural(r.used, r.onlyFailures ? "failed trial" : "trial"));
}

std::string describeDurations(const ConditionResult& r) {
  if (r.used == 0 || std::abs(r.durationRatio - 1) <= kKeptDuration) return {};
  const std::string text = fmt::format(
      "The movements last {:.0f} % of what the criteria predict for the task's T under the same onset rule; ", 100 * r.durationRatio);
  return text + (r.predictedForMoved
                     ? "predictions are for the duration that was moved, each criterion with its own T."
                     : "predictions for the task's T are scaled to them, which an object with its own frequencies does not quite allow.");
}

}  // namespace reachlab::analyze
