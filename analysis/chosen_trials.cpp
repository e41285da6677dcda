#include "analysis/chosen_trials.h"

#include <algorithm>
#include <map>

#include "analysis/dataset.h"

namespace reachlab::analysis {

namespace {

// Trial by trial, as they are read. Returns the conditions of what was read.
std::vector<Condition> readInto(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn,
                                const std::function<void(TrialData&& trial, std::size_t condition)>& add) {
  DatasetIndex index;
  ScenesOfRuns parsed;
  for (const ChosenTrials& some : chosen) {
    if (goOn && !goOn()) break;
    const record::RunLog log = record::RunLog::open(some.log, record::LogCheck::Trials);
    const record::RunConfiguration& c = log.configuration();
    RunSource run{c, {}, [&](std::uint64_t first, std::uint64_t last) { return log.rows(first, last); }, record::readMarks(log)};
    for (const int number : some.trials) {
      const auto trial = std::find_if(log.trials().begin(), log.trials().end(), [&](const auto& t) { return t.trial == number; });
      if (trial != log.trials().end()) run.trials.push_back(*trial);
    }
    addRun(run, parsed.of(c), index, {add, {}});
  }
  return std::move(index.conditions);
}

}  // namespace

AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn) {
  AnalysisInput input;
  input.conditions = readInto(chosen, goOn, [&](TrialData&& trial, std::size_t condition) {
    input.trials.push_back(std::move(trial));
    input.conditionOf.push_back(condition);
  });
  return input;
}

Analysis analyzeChosen(std::span<const ChosenTrials> chosen, const AnalysisOptions& options, const ChosenProgress& progress) {
  AnalysisBuilder builder(options);
  std::vector<Condition> conditions = readInto(chosen, {}, [&](TrialData&& trial, std::size_t condition) {
    if (progress) progress();
    builder.add(std::move(trial), condition);
  });
  return builder.finish(std::move(conditions), [&](std::size_t, std::size_t) {
    if (progress) progress();
  });
}

}  // namespace reachlab::analysis
