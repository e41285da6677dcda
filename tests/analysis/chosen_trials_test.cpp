#include "analysis/chosen_trials.h"

#include <gtest/gtest.h>

#include <fstream>

#include "analysis/dataset.h"
#include "sim/record/trial_marks.h"
#include "tests/analysis/recorded.h"
#include "tests/analysis/whole_dataset.h"

namespace reachlab::analysis {
namespace {

std::string logIn(const TemporaryFolder& folder) { return folder.path() + "/sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach"; }

AnalysisOptions quick() {
  AnalysisOptions options;
  options.criteria = {predict::Criterion::MinHandJerk};
  return options;
}

// Bit for bit: the window's numbers are those of the whole dataset's analysis.
TEST(ChosenTrials, AreTheTrialsOfTheDatasetAsTheAnalysisReadsThem) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 12});
  const Dataset all = openDataset(folder.path());
  const AnalysisInput some = readChosen(std::vector<ChosenTrials>{{logIn(folder), {2, 5, 99}}});
  ASSERT_EQ(some.trials.size(), 2u) << "there is no trial 99";
  EXPECT_EQ(some.trials[1].key.trial, 5);
  EXPECT_EQ(some.trials[1].hand, all.input.trials[4].hand);
  EXPECT_EQ(some.trials[1].first, all.input.trials[4].first);
  ChosenTrials every{logIn(folder), {}};
  for (int t = 1; t <= 12; ++t) every.trials.push_back(t);
  const Analysis a = analyzeTrials(readChosen(std::vector{every}), {}), b = analyzeTrials(all.input, {});
  ASSERT_EQ(a.people.size(), 1u);
  ASSERT_EQ(a.people[0].fitted, b.people[0].fitted);
  ASSERT_EQ(a.results[0].handEpsilon.size(), b.results[0].handEpsilon.size());
  for (std::size_t i = 0; i < a.results[0].handEpsilon.size(); ++i)
    EXPECT_EQ(a.results[0].handEpsilon[i].epsilon, b.results[0].handEpsilon[i].epsilon);
  for (std::size_t k = 0; k < a.people[0].fit.candidates.size(); ++k)
    EXPECT_EQ(a.people[0].fit.candidates[k].epsilonOfAll, b.people[0].fit.candidates[k].epsilonOfAll);
  // Trial by trial, with no sample kept, they are the same again. An exception of the progress ends it.
  int told = 0;
  const Analysis c = analyzeChosen(std::vector{every}, {}, [&] { ++told; });
  EXPECT_GT(told, 12) << "each trial is read, and then there are fits";
  ASSERT_EQ(c.people.size(), 1u);
  for (std::size_t k = 0; k < c.people[0].fit.candidates.size(); ++k)
    EXPECT_EQ(c.people[0].fit.candidates[k].epsilonOfAll, b.people[0].fit.candidates[k].epsilonOfAll);
  struct Enough {};
  EXPECT_THROW((void)analyzeChosen(std::vector{every}, {}, [] { throw Enough{}; }), Enough);
}

TEST(Marks, ExcludeATrialWithItsReasonAndMoveOnsetAndEnd) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 3});
  const Dataset before = openDataset(folder.path());
  const Analysis plain = analyzeTrials(before.input, quick());
  const double onset = plain.trials[1].measures.onset, offset = plain.trials[1].measures.offset;
  record::RunMarks marks;
  marks.set({.trial = 1, .excluded = "talked"});
  marks.set({.trial = 2, .onset = onset + 0.05, .offset = offset - 0.1});
  marks.set({.trial = 3, .flagged = true, .note = "look again"});
  record::writeMarks(logIn(folder), marks);
  const Dataset after = openDataset(folder.path());
  const Analysis analysis = analyzeTrials(after.input, quick());
  EXPECT_EQ(analysis.trials[0].exclusion, "excluded: talked");
  EXPECT_FALSE(analysis.trials[0].counted) << "neither success nor failure";
  EXPECT_EQ(analysis.results[0].exclusions.at("excluded: talked"), 1u);
  const auto judged = [](const Analysis& s) { return s.results[0].counts.success + s.results[0].counts.failure; };
  EXPECT_EQ(judged(analysis) + 1, judged(plain));
  EXPECT_DOUBLE_EQ(analysis.trials[1].measures.onset, onset + 0.05);
  EXPECT_DOUBLE_EQ(analysis.trials[1].measures.offset, offset - 0.1);
  EXPECT_DOUBLE_EQ(analysis.trials[2].measures.onset, plain.trials[2].measures.onset) << "a flag changes no number";
}

TEST(Marks, ThatCannotBeReadLeaveTheirRunOut) {
  const TemporaryFolder folder;
  recordRun(folder.path(), {.experiment = "chain-moderate", .trials = 2});
  recordRun(folder.path(), {.experiment = "chain-fast", .trials = 1});
  std::ofstream(record::marksPathOf(logIn(folder))) << "{";
  const Dataset dataset = openDataset(folder.path());
  EXPECT_EQ(dataset.input.trials.size(), 1u);
  ASSERT_EQ(dataset.notes.size(), 1u);
  EXPECT_NE(dataset.notes[0].find("_marks.json:1:"), std::string::npos) << dataset.notes[0];
}

}  // namespace
}  // namespace reachlab::analysis
