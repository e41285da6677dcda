#include "sim/record/trial_marks.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "tests/analysis/recorded.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

class TrialMarks : public analysis::RecordedDataset {};

TEST_F(TrialMarks, StandBesideTheLogAndReadBackEqual) {
  const std::string log = folder_.path() + "/sub-01_ses-01_task-x_run-01_log.reach";
  EXPECT_EQ(marksPathOf(log), folder_.path() + "/sub-01_ses-01_task-x_run-01_marks.json");
  EXPECT_TRUE(readMarks(log).trials.empty()) << "no file, no marks";
  RunMarks marks;
  marks.set({.trial = 7, .flagged = true, .note = "sneezed, \"loudly\""});
  marks.set({.trial = 2, .excluded = "talked", .onset = 0.1 + 0.2, .offset = 1.25});
  ASSERT_EQ(marks.trials.front().trial, 2) << "in the order of the trials";
  writeMarks(log, marks);
  EXPECT_EQ(readMarks(log), marks);
  ASSERT_NE(marks.find(7), nullptr);
  EXPECT_EQ(marks.find(3), nullptr);
  marks.set({.trial = 7});
  marks.set({.trial = 2});
  EXPECT_TRUE(marks.trials.empty()) << "what says nothing is forgotten";
  writeMarks(log, marks);
  EXPECT_FALSE(std::filesystem::exists(marksPathOf(log)));
}

TEST_F(TrialMarks, AFaultyFileIsToldWithItsPlaces) {
  std::ofstream(marksPathOf(log_)) << R"({"schema_version": 1, "trials": [{"trial": 0, "onset_s": 2, "offset_s": 1, "excludde": "x"}]})";
  const std::string text = refusalOf([&] { (void)readMarks(log_); });
  for (const char* part : {"a_marks.json:1:", "trials[0].trial", "trials[0].offset_s: is not after onset_s", "excludde"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
}

// The later of two lines of one trial would undo the exclusion that the earlier one asks for.
TEST_F(TrialMarks, OfATrialThatIsNamedTwiceAreRefused) {
  std::ofstream(marksPathOf(log_))
      << R"({"schema_version": 1, "trials": [{"trial": 3, "excluded": "talked"}, {"trial": 3, "flagged": true}]})";
  EXPECT_TRUE(holds(refusalOf([&] { (void)readMarks(log_); }), "trials[1].trial: is 3 for the second time"));
}

TEST_F(TrialMarks, OfATrialThatTheRunDoesNotHaveAreRefused) {
  const std::string log = record({.trials = 2});
  std::ofstream(marksPathOf(log))
      << R"({"schema_version": 1, "trials": [{"trial": 2, "flagged": true}, {"trial": 300, "excluded": "talked"}]})";
  EXPECT_NO_THROW((void)readMarks(log)) << "a run that goes on may still have it";
  const std::string said = refusalOf([&] { (void)readMarks(RunLog::open(log)); });
  EXPECT_NE(said.find("trials[1].trial: is 300, which the run does not have"), std::string::npos) << said;
  EXPECT_NE(said.find("1 to 2"), std::string::npos) << said;
  EXPECT_TRUE(holds(refusalOf([&] { (void)opened(); }), "is 300"));
}

TEST_F(TrialMarks, TimesReachAMillionSecondsAndNoFurther) {
  const auto write = [&](const char* onset) {
    std::ofstream(marksPathOf(log_)) << R"({"schema_version": 1, "trials": [{"trial": 1, "onset_s": )" << onset << "}]}";
  };
  write("1000000");
  EXPECT_EQ(readMarks(log_).trials.at(0).onset, 1e6);
  write("1000001");
  EXPECT_THROW((void)readMarks(log_), Error);
  write("-1e-9");
  EXPECT_THROW((void)readMarks(log_), Error);
}

}  // namespace
}  // namespace reachlab::record
