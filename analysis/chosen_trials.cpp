#include "analysis/chosen_trials.h"

#include <algorithm>
#include <map>

#include "analysis/dataset.h"

namespace reachlab::analysis {

AnalysisInput readChosen(std::span<const ChosenTrials> chosen, const std::function<bool()>& goOn) {
  AnalysisInput input;
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
    addRun(run, parsed.of(c), index,
           {[&](TrialData&& trial, std::size_t condition) {
              input.trials.push_back(std::move(trial));
              input.conditionOf.push_back(condition);
            },
            {}});
  }
  input.conditions = index.conditions;
  return input;
}

}  // namespace reachlab::analysis
