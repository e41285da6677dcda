#pragma once
#include <optional>
#include <string>
#include <vector>

#include "analysis/conclusions/comparison.h"
#include "analysis/measures/statistics.h"

/// Success by person and day and over trials, and the effects of day and pace on it, with people as the unit. Pure functions for any
/// thread.
namespace reachlab::analysis {

/// One attempt, in the order they were made.
struct Attempt {
  std::string subject, session;
  int day = 0;
  std::size_t condition = 0;
  bool success = false;
};

/// A cell of Table 2.
struct SuccessCell {
  std::string subject;
  int day = 0;
  std::size_t condition = 0, successes = 0, trials = 0;
  Bounds interval;  // Clopper and Pearson's exact one, of this person's share
  double share() const { return static_cast<double>(successes) / static_cast<double>(trials); }
};
/// Table 2: successes by subject, day and condition. Attempts sorted by condition, then subject.
std::vector<SuccessCell> successTable(const std::vector<Attempt>& attempts);

struct LearningPoint {
  std::string subject, session;
  std::size_t condition = 0;
  int firstTrial = 0, lastTrial = 0;  // counted through all the subject's sessions of this condition, from 1
  std::size_t successes = 0, trials = 0;
  Bounds interval;  // exact
};
/// Success over consecutive groups of `bin` attempts of one subject and condition. A group never spans two sessions.
std::vector<LearningPoint> learningCurves(const std::vector<Attempt>& attempts, int bin);

/// A mean over people with its 95 % interval.
struct MeanInterval {
  double mean = 0;
  Bounds interval;
  std::size_t people = 0;
};
/// The share of a typical person in one condition, on one day or on all days. It is the mean over people of the empirical logits
/// ln((s + 1/2) / (f + 1/2)), turned back into a share. A t interval about the mean of shares covers too seldom if shares are near 0 or 1.
/// nullopt for fewer than two people.
std::optional<MeanInterval> typicalShare(const std::vector<SuccessCell>& cells, std::size_t condition, std::optional<int> day = {});

/// A paired difference over people: D2 - D1 within a condition, or the difference of two conditions. It is given in percentage points,
/// and as the logarithm of an odds ratio. The odds ratio comes from a logistic model of two stages. The first is the empirical logit
/// ln((s + 1/2) / (f + 1/2)) of each person's cell. The second is a paired t over people. The binomial scatter of the trials limits its
/// certainty.
struct Effect {
  bool ofDay = false;  // day `to` - day `from` of condition `condition`; else condition `to` - `from` on all common days
  std::size_t condition = 0;
  int from = 0, to = 0;
  std::size_t people = 0;
  TTest points = {};  // in percentage points
  Bounds pointsInterval = {};
  TTest logit = {};
  Bounds logitInterval = {};
  double p = 1;  // of the logit, Holm-corrected over all effects of days, or of conditions
};
std::vector<Effect> effectsOf(const std::vector<SuccessCell>& cells, std::size_t conditions);

/// Learning: each person's slope of success against trial number (least squares), its mean over people, t interval.
struct LearningSlope {
  std::size_t condition = 0, people = 0;
  double perHundred = 0;  // [percentage points / 100 trials]
  Bounds interval;        // infinite for one person
  double p = 1;
};
std::vector<LearningSlope> learningSlopes(const std::vector<Attempt>& attempts, std::size_t conditions);

}  // namespace reachlab::analysis
