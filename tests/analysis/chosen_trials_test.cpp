#include "analysis/chosen_trials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "analysis/dataset.h"
#include "base/fault.h"
#include "sim/record/trial_marks.h"
#include "tests/analysis/recorded.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

class TrialsThatAreChosen : public RecordedDataset {};
class Marks : public RecordedDataset {};

// Bit for bit: the window's numbers are those of the whole dataset's analysis.
TEST_F(TrialsThatAreChosen, AreTheTrialsOfTheDatasetAsTheAnalysisReadsThem) {
  const std::string log = record({.trials = 12});
  const Dataset all = opened();
  const AnalysisInput some = readChosen(std::vector<ChosenTrials>{{log, {2, 5, 99}}});
  ASSERT_EQ(some.trials.size(), 2u) << "there is no trial 99";
  EXPECT_EQ(some.trials[1].key.trial, 5);
  EXPECT_EQ(some.trials[1].hand, all.input.trials[4].hand);
  EXPECT_EQ(some.trials[1].first, all.input.trials[4].first);
  ChosenTrials every{log, {}};
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

TEST_F(TrialsThatAreChosen, OfADatasetWithoutLogsAreThoseOfItsLogs) {
  const std::string log = record({.trials = 3});
  const AnalysisInput before = readChosen(std::vector<ChosenTrials>{{log, {1, 3}}});
  removeLogs(folder_.path(), log);
  const record::TrialIndex index = indexMotionFiles(folder_.path());
  ASSERT_EQ(index.runs.size(), 1u) << (index.unreadable.empty() ? "" : index.unreadable.front());
  EXPECT_EQ(index.runs[0].subject, "01");
  ASSERT_EQ(index.runs[0].trials.size(), 3u);
  EXPECT_TRUE(std::isnan(index.runs[0].trials[0].peakHandSpeed)) << "not known, and not 0";
  const AnalysisInput after = readChosen(std::vector<ChosenTrials>{{index.runs[0].path, {1, 3}}});
  ASSERT_EQ(after.trials.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.trials[i].hand, before.trials[i].hand);
    EXPECT_EQ(after.trials[i].key.trial, before.trials[i].key.trial);
    EXPECT_EQ(after.trials[i].result.outcome, before.trials[i].result.outcome);
  }
}

TEST_F(TrialsThatAreChosen, OfAnotherProgramsMotionFilesAreRefusedByTheName) {
  std::filesystem::create_directories(folder_.path() + "/sub-01/motion");
  std::ofstream(folder_.path() + "/sub-01/motion/sub-01_task-walk_tracksys-imu_motion.tsv") << "0\t1\n";
  EXPECT_TRUE(holds(refusalOf<FaultError>([&] { (void)indexMotionFiles(folder_.path()); }), "not of Reachlab: tracksys-imu"));
}

TEST_F(Marks, ExcludeATrialWithItsReasonAndMoveOnsetAndEnd) {
  const std::string log = record({.trials = 3});
  const Dataset before = opened();
  const Analysis plain = analyzeTrials(before.input, fewCriteria());
  const double onset = plain.trials[1].measures.onset, offset = plain.trials[1].measures.offset;
  record::RunMarks marks;
  marks.set({.trial = 1, .excluded = "talked"});
  marks.set({.trial = 2, .onset = onset + 0.05, .offset = offset - 0.1});
  marks.set({.trial = 3, .flagged = true, .note = "look again"});
  record::writeMarks(log, marks);
  const Dataset after = opened();
  const Analysis analysis = analyzeTrials(after.input, fewCriteria());
  EXPECT_EQ(analysis.trials[0].exclusion, "excluded: talked");
  EXPECT_FALSE(analysis.trials[0].counted) << "neither success nor failure";
  EXPECT_EQ(analysis.results[0].exclusions.at("excluded: talked"), 1u);
  const auto judged = [](const Analysis& s) { return s.results[0].counts.success + s.results[0].counts.failure; };
  EXPECT_EQ(judged(analysis) + 1, judged(plain));
  EXPECT_DOUBLE_EQ(analysis.trials[1].measures.onset, onset + 0.05);
  EXPECT_DOUBLE_EQ(analysis.trials[1].measures.offset, offset - 0.1);
  EXPECT_DOUBLE_EQ(analysis.trials[2].measures.onset, plain.trials[2].measures.onset) << "a flag changes no number";
}

TEST_F(Marks, ThatCannotBeReadLeaveTheirRunOut) {
  const std::string log = record({.trials = 2});
  record({.experiment = "chain-fast", .trials = 1});
  std::ofstream(record::marksPathOf(log)) << "{";
  const Dataset dataset = opened();
  EXPECT_EQ(dataset.input.trials.size(), 1u);
  ASSERT_EQ(dataset.notes.size(), 1u);
  EXPECT_NE(dataset.notes[0].find("_marks.json:1:"), std::string::npos) << dataset.notes[0];
}

}  // namespace
}  // namespace reachlab::analysis
