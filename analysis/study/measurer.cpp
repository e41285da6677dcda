#include "analysis/study/measurer.h"

#include <algorithm>

#include "analysis/conclusions/fit_window.h"
#include "analysis/conclusions/person_fit.h"
#include "analysis/measures/deviation_and_adaptation.h"
#include "base/error.h"
#include "sim/experiment/experiment.h"

namespace reachlab::study {

Measurer::Measurer(const Design& design, const experiment::CompiledExperiment& experiment)
    : design_(design), experiment_(experiment), needs_(needsOf(design)), criteria_(criteriaOf(design)) {
  if (!needs_.errors) return;
  for (const predict::Criterion criterion : criteria_) {
    signals_.emplace_back();
    try {
      const auto prediction = predict::predict(experiment_, criterion);
      signals_.back() = analysis::recordPrediction(*prediction, options_, *experiment_.experiment().task);
    } catch (const Error&) {  // not defined here: an empty column says so
    }
  }
}

MeasuredTrial Measurer::measure(const BlockRun& run, const record::RecordedTrial& recorded, bool practice, std::size_t place) {
  MeasuredTrial trial;
  trial.recorded = recorded;
  if (!needs_.samples) return trial;
  const analysis::RunTrials trials(run.table(), BlockRun::kSampleEvery,
                                   {experiment_.constraint(), experiment_.experiment().task->start, experiment_.experiment().task->target},
                                   analysis::sceneOf(experiment_.experiment(), analysis::viscousFieldOf(experiment_.experiment())));
  const analysis::TrialData data =
      trials.read(recorded, [&](std::uint64_t first, std::uint64_t last) { return run.rows().between(first, last); });
  const analysis::TrialSignals signals = analysis::computeSignals(data, options_);
  trial.measures = analysis::computeMeasures(data, signals);
  const bool used =
      signals.movement.found && !practice && !recorded.planned.catchTrial && recorded.result.outcome == trial::Outcome::Success;
  if (!signals.movement.found || !(needs_.errors || needs_.fits || design_.profiles)) return trial;
  const analysis::TrialProfile profile = analysis::makeTrialProfile(data, signals);
  if (design_.profiles) {
    for (const std::vector<double>* velocity : {&profile.hand, &profile.object})
      for (const double v : *velocity) trial.profile.push_back(static_cast<float>(v));
  }
  if (needs_.errors && used) {
    for (const auto& signal : signals_) {
      const analysis::PaperError error =
          signal ? analysis::computePaperError(profile, *signal) : analysis::PaperError{analysis::kNotMeasured, analysis::kNotMeasured};
      trial.epsilonHand.push_back(error.hand);
      trial.epsilonObject.push_back(error.object);
    }
  }
  if (needs_.fits && used)
    if (auto window = analysis::makeFitWindow(data, signals)) {
      windows_.push_back(std::move(*window));
      durations_.push_back(trial.measures.duration);
      windowOf_.push_back(place);
    }
  return trial;
}

void Measurer::fitBlock(std::vector<MeasuredTrial>& trials, std::size_t first) {
  if (windows_.size() >= analysis::kFewestTrials) {
    if (!haveCandidates_) {
      analysis::CandidateOptions how;
      how.criteria = criteria_;
      how.cutoff = options_.cutoff;
      how.rate = windows_.front().rate;
      candidates_ = analysis::makeCandidates(experiment_, how);
      haveCandidates_ = true;
    }
    const analysis::PersonFit fit = analysis::fitPerson(windows_, durations_, candidates_);
    for (std::size_t i = 0; i < windowOf_.size(); ++i) {
      std::vector<double>& score = trials[first + windowOf_[i]].score;
      score.assign(criteria_.size() + 3, analysis::kNotMeasured);
      score[criteria_.size() + 1] = fit.own.effectiveSamples;
      score[criteria_.size() + 2] = fit.own.score[i];
      for (std::size_t k = 0; k < candidates_.candidates.size(); ++k) {
        const analysis::Candidate& candidate = candidates_.candidates[k];
        if (candidate.reference()) score[criteria_.size()] = fit.candidates[k].score[i];
        for (const predict::Criterion criterion : candidate.criteria)
          score[static_cast<std::size_t>(std::find(criteria_.begin(), criteria_.end(), criterion) - criteria_.begin())] =
              fit.candidates[k].score[i];
      }
    }
  }
  windows_.clear();
  durations_.clear();
  windowOf_.clear();
}

}  // namespace reachlab::study
