// The shipped plans of adaptation, recorded with a virtual subject that learns, and measured from the log.
#include <cmath>
#include <map>
#include <set>

#include "analysis/dataset.h"
#include "analysis/measures/measures.h"
#include "analysis/report/report.h"
#include "analysis/report/wording.h"
#include "sim/subjects/subject_kinds.h"
#include "sim/record/replay.h"
#include "tests/session/recorded_runs.h"

namespace reachlab::analysis {
namespace {

class AdaptationPlans : public session::test::Recorded {
 protected:
  /// Mean of a measure of the trials of one block and kind, from trial `first` to `last` of them.
  using Series = std::map<std::pair<int, std::string>, std::vector<TrialMeasures>>;

  Series recordAndMeasure(const std::string& plan) {
    request_.trials.reset();
    request_.device = "simulated:kind=ofc,noise=0.3,subject=1";
    std::shared_ptr<void> learnt;
    session::RecordedSession session(session::readProgramme(plan), request_, [&](const std::string& spec, auto scenes, std::uint64_t seed) {
      return subjects::prepareSubjects(scenes, spec)(seed, 0, learnt);
    });
    session::SessionWords words;
    words.opened = words.logClosed = [](const session::RecordedRun&) {};
    words.closed = [] {};
    words.ended = [](const session::RecordedRun&, const haptics::ConductedTrial&) {};
    EXPECT_TRUE(session::conduct(session, session::test::kNeverStop, words));
    Series series;
    for (const record::RunLog& log : logs()) {
      EXPECT_EQ(record::replayRun(log).rowsThatDiffer, 0u) << log.path();
      ++blocks_;
    }
    const MeasureOptions options;
    AnalysisBuilder builder(AnalysisOptions{});
    const auto take = [&](TrialData&& trial, std::size_t condition) {
      series[{trial.key.block, trial.key.kind}].push_back(computeMeasures(trial, computeSignals(trial, options)));
      targets_.insert(trial.key.target);
      builder.add(std::move(trial), condition);
    };
    const DatasetIndex index = readDataset(request_.place.data, {take});
    for (const Condition& condition : index.conditions) conditions_.insert(condition.name);
    const Analysis analysis = builder.finish(index.conditions);
    figures_ = makeFigures(analysis, {}).size();
    report_ = makeReport({}, analysis, {}, {}, {});
    return series;
  }
  static double mean(const std::vector<TrialMeasures>& of, double TrialMeasures::*value, std::size_t from, std::size_t to) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = from; i < std::min(to, of.size()); ++i)
      if (std::isfinite(of[i].*value)) sum += of[i].*value, ++count;
    EXPECT_GT(count, 0);
    return sum / count;
  }
  int blocks_ = 0;
  std::set<std::string> conditions_, targets_;
  std::size_t figures_ = 0;
  std::string report_;
};

TEST_F(AdaptationPlans, ToACurlFieldLowersTheErrorFillsTheChannelAndLeavesAnAfterEffect) {
  Series series = recordAndMeasure("curl-adaptation");
  EXPECT_EQ(blocks_, 3);
  const auto& field = series.at({2, "field"});
  const auto& channel = series.at({2, "channel"});
  const auto& before = series.at({1, "null"});
  const auto& after = series.at({3, "null"});
  ASSERT_EQ(field.size(), 140u);
  ASSERT_EQ(channel.size(), 20u);
  const double first = mean(field, &TrialMeasures::maxPerpendicular, 0, 4), last = mean(field, &TrialMeasures::maxPerpendicular, 120, 140);
  EXPECT_LT(first, -0.005) << "to the left, where this field pushes";
  EXPECT_LT(std::abs(last), 0.6 * std::abs(first));
  const double aftereffect = mean(after, &TrialMeasures::maxPerpendicular, 0, 4);
  EXPECT_GT(aftereffect, 0.3 * std::abs(first)) << "to the other side";
  EXPECT_LT(std::abs(mean(before, &TrialMeasures::maxPerpendicular, 0, 35)), 0.2 * std::abs(first));
  const double start = mean(channel, &TrialMeasures::adaptation, 0, 3), end = mean(channel, &TrialMeasures::adaptation, 15, 20);
  EXPECT_GT(end, start + 10);
  EXPECT_GT(end, 40);

  EXPECT_EQ(conditions_, (std::set<std::string>{"adaptation channel", "adaptation field", "baseline channel", "baseline null",
                                                "washout channel", "washout null"}))
      << "by kind";
  EXPECT_EQ(targets_.size(), 8u) << "each trial keeps its target";
  EXPECT_LE(figures_, 20u);
  const std::string sentence = report_.substr(report_.find("answer finding"), 400);
  EXPECT_NE(sentence.find("In a counterclockwise curl field of 13 N s/m, 1 subject learned to cancel "), std::string::npos) << sentence;
  EXPECT_NE(sentence.find(" to the right, against the deviation at first (after-effect)."), std::string::npos) << sentence;
}

TEST_F(AdaptationPlans, ToARotationTurnsTheHandAgainstIt) {
  Series series = recordAndMeasure("rotation-30");
  const auto& rotated = series.at({2, "rotated"});
  ASSERT_EQ(rotated.size(), 160u);
  const double first = mean(rotated, &TrialMeasures::handAngle, 0, 4), last = mean(rotated, &TrialMeasures::handAngle, 140, 160);
  EXPECT_LT(std::abs(first), 12);
  EXPECT_LT(last, -15) << "clockwise, against a rotation of 30 degrees counterclockwise";
  EXPECT_LT(mean(series.at({3, "aligned"}), &TrialMeasures::handAngle, 0, 3), -8) << "an after-effect";
  EXPECT_NE(report_.find("In a rotation of the cursor by 30° counterclockwise, 1 subject learned to cancel "), std::string::npos);
}

}  // namespace
}  // namespace reachlab::analysis
