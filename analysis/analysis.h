#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/conclusions/candidates.h"
#include "analysis/conclusions/conclusion.h"
#include "analysis/conclusions/person_fit.h"
#include "analysis/conclusions/progress_model.h"
#include "analysis/measures/measures.h"
#include "analysis/measures/paper_error.h"
#include "analysis/trials/signal_store.h"
#include "sim/experiment/compiled_experiment.h"

/// From recorded trials to everything that tables, figures and report show. Pure: the same trials and options give the same numbers.
namespace reachlab::analysis {

/// The duration T for which predictions of the paper's epsilon are made. Task: the duration of the task. Moved: for each criterion the T
/// whose movement lasts as long as the trials did. The fits choose their durations themselves and do not use this.
enum class PredictionDuration { Task, Moved };

struct AnalysisOptions {
  MeasureOptions measure;
  bool includePractice = false;
  bool includeFailures = false;              // failed trials are used as successful ones are
  std::vector<predict::Criterion> criteria;  // compared criteria, empty: all criteria that are defined for the object
  std::vector<predict::Criterion> drawn;     // in figures, predictions and the paper's epsilon, empty: the compared criteria
  std::optional<double> handMass;            // [kg] of the predictions; nullopt: the experiment's
  std::vector<double> handMasses{kHandMasses.begin(), kHandMasses.end()};  // [kg] that the fits of (4) to (6) try where no mass is given
  double handDamping = 0;                                                  // [N s/m]
  PredictionDuration predictFor = PredictionDuration::Task;
  int learningBin = 10;      // trials a point of the learning curve
  bool keepScatter = false;  // of people's movements, for recovery
  bool residuals = false;    // residuals.csv is written, about 40 kB per trial
};

/// A condition's name, and the experiment that it was recorded with.
struct Condition {
  std::string name;
  experiment::CompiledExperiment compiled;
  bool pooled = false;  // trials to several targets at one distance; `compiled` is that of the first target
  const experiment::Experiment& experiment() const { return compiled.experiment(); }
};

/// Recorded trials in any order, each with the index of its condition. They are a whole dataset or chosen trials.
struct AnalysisInput {
  std::vector<Condition> conditions;
  std::vector<TrialData> trials;
  std::vector<std::size_t> conditionOf;  // one a trial
};

/// One trial after measurement. Its signals are in `Analysis::signals`.
struct AnalyzedTrial : TrialFacts {
  std::size_t condition = 0;
  bool otherWay = false;  // it went round a closed curve the other way
  std::string exclusion;  // why it is not in the profiles and errors; empty: it is
  bool counted = false;   // success or failure of a proper trial: it counts for success rates
  TrialMeasures measures;
  double endLevel = 0;                     // the hand's speed at its end, as a part of its peak
  SignalStore::Row profile;                // 101 points of the hand's velocity, then of the object's; none without a movement
  SignalStore::Row window;                 // what the fits are made to
  double windowBegin = 0, windowRate = 0;  // [s], [Hz]
  std::vector<double> paperError;          // [m/s] of the hand, then of the object, one a criterion; empty if not used
  bool used() const { return exclusion.empty(); }
  bool isExcluded() const { return exclusion.starts_with("excluded"); }       // by a person
  bool isLeftOut() const { return exclusion == "practice" || isExcluded(); }  // whatever came of it
};

/// Mean and SD over the used trials at each of the 101 points, time-scaled to the condition's mean duration. [m/s]
struct MeanProfile {
  std::vector<double> mean, sd;
};

struct ConditionCounts {
  std::size_t success = 0, failure = 0, aborted = 0, interrupted = 0, practice = 0, catchTrials = 0;
  std::size_t invalidTiming = 0;  // of the interrupted ones
  std::size_t beforeGo = 0;       // the hand left before the go signal
  std::size_t otherWay = 0;       // round a closed curve the other way
};

/// The paper's epsilon of one criterion in one condition, over all samples of the used trials. The interval is over people.
struct EpsilonPlace {
  std::size_t criterion = 0;                 // index into ConditionResult::signals
  double epsilon = 0;                        // [m/s]
  double mean = 0;                           // [m/s] of people's own epsilons
  std::optional<Bounds> interval;            // of that mean
  double difference = 0;                     // mean over people of epsilon - that of the first
  std::optional<Bounds> differenceInterval;  // Bonferroni-corrected for the number of criteria compared with the first
  bool apart = false;                        // that interval excludes 0
};
using EpsilonTable = std::vector<EpsilonPlace>;  // least first

/// One person's trials of a condition, fitted.
struct PersonResult {
  std::string subject;
  std::size_t condition = 0;
  std::size_t firstTrial = 0, trials = 0;  // range of the used trials in Analysis::trials
  double duration = 0;                     // [s] mean by the onset rule
  bool fitted = false;                     // kFewestTrials or more
  PersonFit fit;
  std::vector<double> rest;  // [m/s m/s] sum w^2 v^2 of each trial
  Conclusion conclusion;     // about this person in this condition
};

struct ConditionResult {
  ConditionCounts counts;
  std::map<std::string, std::size_t> reasons;  // of failures and aborts, by machine-readable name
  std::map<std::string, std::size_t> exclusions;
  std::size_t used = 0;
  bool onlyFailures = false;      // no trial succeeded: what is used are the failed ones, for description
  MeanSd duration, movementTime;  // [s] over the used trials: by the onset rule, by the task
  Bounds movementRange;           // [s] least and largest movement time of the used trials
  MeanProfile hand, object;
  double endLevel = 0;                   // mean of the used trials
  std::vector<PredictedSignal> signals;  // of the paper's epsilon, with their predictions
  std::optional<PredictedSignal> moved;  // (1) for the T whose movement lasts as long as the trials did; empty where `signals` have it
  std::vector<std::string> refusals;     // criteria that cannot be predicted here, and why
  EpsilonTable handEpsilon, objectEpsilon;
  CandidateSet candidates;              // of the fits
  Conclusion conclusion;                // indexes `candidates`
  std::optional<MeanInterval> success;  // share of a typical person

  bool predicts(predict::Criterion criterion) const;
};

/// RMS error of one series: one subject, session, run.
struct SeriesResult {
  TrialKey key;  // trial 0
  std::size_t condition = 0, trials = 0;
  std::vector<double> handError, objectError;  // [m/s] one a criterion
};

/// What an analysis with another choice concludes (report/alternatives.h).
struct AlternativeConclusion {
  std::string choice, condition;  // "cut-off 6 Hz"; a condition, or "all"
  Conclusion conclusion;
  std::vector<std::vector<predict::Criterion>> candidates;  // that `conclusion` indexes
  bool changed = false;
  std::string criterion() const;  // that is named; empty where none is
  std::string best() const;       // closest candidate; empty where nothing could be compared
  std::optional<double> p() const { return conclusion.best ? std::optional(conclusion.p) : std::nullopt; }  // of its nearest rival
};

struct Analysis {
  AnalysisOptions options;
  std::vector<Condition> conditions;
  std::vector<ConditionResult> results;  // one a condition
  std::vector<AnalyzedTrial> trials;     // sorted by condition, subject, session, run, trial
  std::vector<SeriesResult> series;
  std::vector<PersonResult> people;                     // by condition, then subject
  std::vector<std::vector<predict::Criterion>> common;  // candidates of the overall conclusion; an empty one is the reference
  std::vector<std::size_t> together;  // conditions of the overall conclusion: those in which every judged subject has enough trials
  Conclusion overall;                 // over all conditions, indexes `common`
  std::vector<AlternativeConclusion> alternatives;  // empty where they were not asked for
  std::vector<std::string> subjects;
  std::vector<SuccessCell> success;
  std::vector<LearningPoint> learning;
  std::vector<Effect> effects;        // of day and pace, over people
  std::vector<LearningSlope> slopes;  // of success against trial number, over people
  std::shared_ptr<const SignalStore> signals;

  TrialProfile profileOf(const AnalyzedTrial& trial) const;  // as measured; empty without a movement
};

using FittingProgress = std::function<void(std::size_t done, std::size_t of)>;

/// Takes the trials one by one and forgets their signals, then judges. Throws FaultError for options out of range.
class AnalysisBuilder {
 public:
  explicit AnalysisBuilder(const AnalysisOptions& options);
  void add(TrialData&& trial, std::size_t condition);
  /// The trials that follow are of one run, which `takeBackRun` forgets.
  void beginRun() { runBegin_ = analysis_.trials.size(); }
  void takeBackRun() { analysis_.trials.resize(runBegin_); }
  Analysis finish(std::vector<Condition> conditions, const FittingProgress& fitting = {});

 private:
  Analysis analysis_;
  std::shared_ptr<SignalStore> signals_;
  std::size_t runBegin_ = 0;
};

Analysis analyzeTrials(AnalysisInput input, const AnalysisOptions& options, const FittingProgress& progress = {});

/// The conclusion of one condition from people's fits. Recovery judges simulated studies by the same function.
Conclusion concludeCondition(const std::vector<PersonResult>& people, std::size_t condition, const CandidateSet& candidates);
PersonScores scoresOf(const PersonResult& person, const CandidateSet& set);
/// The scores of the candidates in `common`, in that order. Each of them must be in `set`.
ConditionScores scoresOf(const PersonResult& person, const CandidateSet& set, const std::vector<std::vector<predict::Criterion>>& common);
/// With a hand of unlimited mass criterion (5) becomes (1): the hand's jerk is all that is left of the change of force.
std::vector<HeavyLimit> heavyLimits(const std::vector<std::vector<predict::Criterion>>& candidates);

}  // namespace reachlab::analysis
