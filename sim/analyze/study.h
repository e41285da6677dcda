#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/analyze/measures.h"
#include "sim/analyze/predicted_profile.h"
#include "sim/analyze/ranking.h"

/// From recorded trials to everything that tables, figures and report show. Pure: the same trials and options give the same numbers.
namespace reachlab::analyze {

/// What T criteria are predicted for. Task: the task's. Moved: for each criterion the T whose movement lasts as long as the trials did.
/// Auto: the task's where the trials kept to it within kKeptDuration, else as Moved.
inline constexpr double kKeptDuration = 0.1;  // a subject's own scatter of T is 7 %
enum class PredictionDuration { Auto, Task, Moved };

struct StudyOptions {
  MeasureOptions measure;
  bool includePractice = false;
  std::vector<predict::Criterion> criteria;  // empty: all that are defined for the object
  std::optional<double> handMass;            // [kg] of the predictions; nullopt: the experiment's
  double handDamping = 0;                    // [N s/m]
  PredictionDuration predictFor = PredictionDuration::Auto;
  RankingOptions ranking;
  int learningBin = 10;  // trials a point of the learning curve
};

/// What a condition asks, and the experiment it was recorded with.
struct StudyCondition {
  std::string name;
  experiment::Experiment experiment;
};

/// A recorded study: trials in any order, each of a condition (index). Filled by openDataset or by a test.
struct StudyInput {
  std::vector<StudyCondition> conditions;
  std::vector<TrialData> trials;
  std::vector<std::size_t> conditionOf;  // one a trial
};

/// One trial after measurement; its heavy signals are gone.
struct StudyTrial {
  TrialKey key;
  std::size_t condition = 0;
  trial::TrialResult result;
  bool practice = false;
  std::string exclusion;  // why it is not in the profiles and errors; empty: it is
  bool counted = false;   // success or failure of a proper trial: it counts for success rates
  TrialMeasures measures;
  std::vector<double> hand, object;            // [m/s] 101 points over its own duration; empty without a movement
  double endLevel = 0;                         // the hand's speed at its end, as a part of its peak
  std::vector<double> handError, objectError;  // [m/s] epsilon against each criterion of its condition; empty if excluded
  bool used() const { return exclusion.empty(); }
};

/// Mean and SD over the used trials at each of the 101 points, time-scaled to the condition's mean duration. [m/s]
struct MeanProfile {
  std::vector<double> mean, sd;
};

struct OutcomeCounts {
  std::size_t success = 0, failure = 0, aborted = 0, interrupted = 0, practice = 0, catchTrials = 0;
};

struct ConditionResult {
  OutcomeCounts counts;
  std::map<std::string, std::size_t> reasons;  // of failures and aborts, by machine-readable name
  std::map<std::string, std::size_t> exclusions;
  std::size_t used = 0;
  bool onlyFailures = false;      // no trial succeeded: what is used are the failed ones, for description
  MeanSd duration, movementTime;  // [s] over the used trials: by the onset rule, by the task
  MeanProfile hand, object;
  double endLevel = 0;                        // mean of the used trials
  std::vector<PredictedSignal> signals;       // one a prediction
  std::vector<PredictedProfile> predictions;  // until endLevel, scaled to duration.mean
  double durationRatio = 1;                   // trials' mean duration / that predicted for the task's T (median over the criteria)
  bool predictedForMoved = false;             // predictions are for the duration that was moved
  std::vector<std::string> refusals;          // criteria that cannot be predicted here, and why
  Ranking handRanking, objectRanking;         // over trials
  std::optional<Ranking> handOverSubjects, objectOverSubjects;
};

/// RMS error of one series: one subject, session, run.
struct SeriesResult {
  TrialKey key;  // trial 0
  std::size_t condition = 0, trials = 0;
  std::vector<double> handError, objectError;  // [m/s] one a criterion
};

struct SuccessCell {
  std::string subject;
  int day = 0;
  std::size_t condition = 0, successes = 0, trials = 0;
  Interval interval;  // Wilson, of the share
};

struct LearningPoint {
  std::string subject, session;
  std::size_t condition = 0;
  int firstTrial = 0, lastTrial = 0;  // counted through all the subject's sessions of this condition, from 1
  std::size_t successes = 0, trials = 0;
  Interval interval;
};

struct StudyResult {
  StudyOptions options;
  std::vector<StudyCondition> conditions;
  std::vector<ConditionResult> results;  // one a condition
  std::vector<StudyTrial> trials;        // sorted by condition, subject, session, run, trial
  std::vector<SeriesResult> series;
  std::vector<SuccessCell> success;
  std::vector<LearningPoint> learning;
  std::vector<predict::Criterion> common;  // criteria predicted in every condition that has used trials
  Ranking overall;                         // hand, all conditions with successes together, places index `common`
  std::optional<Ranking> overallOverSubjects;
  std::vector<std::string> subjects;
};

using StudyProgress = std::function<void(std::size_t done, std::size_t of)>;

/// Consumes the trials (their signals are freed one by one). Throws UsageError for options out of range.
StudyResult analyzeStudy(StudyInput input, const StudyOptions& options, const StudyProgress& progress = {});

}  // namespace reachlab::analyze
