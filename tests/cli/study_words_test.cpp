#include "cli/output/study_words.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "cli/output/success_table.h"
#include "cli/output/trial_line.h"

namespace reachlab::cli {
namespace {

// A share as "I/N", or what is said of the text.
std::string shareOf(const std::string& text) {
  try {
    const study::Shard shard = shardOf(text);
    return std::to_string(shard.index) + "/" + std::to_string(shard.of);
  } catch (const FaultError& refusal) {
    return refusal.what();
  }
}

// Variables of the environment for as long as it is there.
class Variables {
 public:
  explicit Variables(std::vector<std::pair<const char*, const char*>> all) : all_(std::move(all)) {
    for (const auto& [name, value] : all_) ::setenv(name, value, 1);
  }
  ~Variables() {
    for (const auto& [name, value] : all_) ::unsetenv(name);
  }
  Variables(const Variables&) = delete;
  Variables& operator=(const Variables&) = delete;

 private:
  std::vector<std::pair<const char*, const char*>> all_;
};

TEST(Share, IsOneOfSoMany) {
  for (const char* good : {"1/1", "1/8", "8/8", "3/10000"}) EXPECT_EQ(shareOf(good), good);
  for (const char* bad : {"0/8", "9/8", "-1/8", "1/0", "1/-1", "1", "/", "1/", "/2", "1/2/3", "a/2", "1/2x", "1.5/2", " 1/2"})
    EXPECT_EQ(shareOf(bad), "--shard: is " + std::string(bad) + "; allowed: I/N with 1 <= I <= N");
}

TEST(Share, WithoutAWordIsAllOrThatOfASlurmArray) {
  EXPECT_EQ(shareOf(""), "1/1");
  {
    const Variables half(std::vector<std::pair<const char*, const char*>>{{"SLURM_ARRAY_TASK_ID", "3"}});
    EXPECT_EQ(shareOf(""), "1/1") << "no array";
  }
  const auto share = [](const char* id, const char* count, const char* least, const char* step) {
    std::vector<std::pair<const char*, const char*>> all{{"SLURM_ARRAY_TASK_ID", id}, {"SLURM_ARRAY_TASK_COUNT", count}};
    if (least != nullptr) all.emplace_back("SLURM_ARRAY_TASK_MIN", least);
    if (step != nullptr) all.emplace_back("SLURM_ARRAY_TASK_STEP", step);
    const Variables variables(all);
    return shareOf("");
  };
  EXPECT_EQ(share("3", "8", nullptr, nullptr), "3/8") << "numbered from 1 by 1";
  EXPECT_EQ(share("0", "8", "0", "1"), "1/8");
  EXPECT_EQ(share("7", "8", "0", "1"), "8/8");
  EXPECT_EQ(share("17", "5", "5", "3"), "5/5");
  EXPECT_EQ(share("11", "5", "5", "3"), "3/5");
  const std::string allowed = ", which is no share; allowed: an array without gaps, or --shard I/N";
  EXPECT_EQ(share("9", "8", nullptr, nullptr), "SLURM_ARRAY_TASK_ID: is 9 of 8 tasks from 1 by 1" + allowed);
  EXPECT_EQ(share("4", "8", "5", "1"), "SLURM_ARRAY_TASK_ID: is 4 of 8 tasks from 5 by 1" + allowed);
  EXPECT_EQ(share("10", "5", "5", "3"), "SLURM_ARRAY_TASK_ID: is 10 of 5 tasks from 5 by 3" + allowed) << "between two tasks";
  EXPECT_EQ(share("1", "1", "1", "0"), "SLURM_ARRAY_TASK_ID: is 1 of 1 tasks from 1 by 0" + allowed);
  EXPECT_EQ(share("1", "0", nullptr, nullptr), "SLURM_ARRAY_TASK_ID: is 1 of 0 tasks from 1 by 1" + allowed);
  EXPECT_EQ(share("x", "8", nullptr, nullptr), "1/1") << "what is no number is not there";
}

TEST(Seconds, AreToldInTheUnitsOfAClockRoundedUp) {
  for (const auto& [seconds, words] : std::vector<std::pair<double, const char*>>{{0, "0 s"},
                                                                                  {0.01, "1 s"},
                                                                                  {12, "12 s"},
                                                                                  {59, "59 s"},
                                                                                  {59.5, "1 min 00 s"},
                                                                                  {200, "3 min 20 s"},
                                                                                  {3599, "59 min 59 s"},
                                                                                  {3600, "1 h 00 min"},
                                                                                  {3720, "1 h 02 min"},
                                                                                  {360'000, "100 h 00 min"},
                                                                                  {7199, "1 h 59 min"}})
    EXPECT_EQ(describeSeconds(seconds), words);
}

trial::TrialResult ended(trial::Outcome outcome, trial::Reason reason, int mass = 0, double by = 0, double time = 0) {
  return {outcome, reason, mass, by, time, 0, 0};
}

TEST(SuccessTable, CountsOutcomesByConditionInTheOrderInWhichTheyCame) {
  using trial::Outcome;
  using trial::Reason;
  SuccessTable table;
  EXPECT_EQ(table.text(), "");
  for (int i = 0; i < 2; ++i) table.add("slow", ended(Outcome::Success, Reason::None));
  table.add("slow", ended(Outcome::Failure, Reason::Velocity));
  table.add("a long condition", ended(Outcome::Aborted, Reason::NoOnset));
  table.add("slow", ended(Outcome::Failure, Reason::Velocity));
  table.add("slow", ended(Outcome::Failure, Reason::Position));
  table.add("slow", ended(Outcome::Interrupted, Reason::DeviceLost));
  table.add("fast", ended(Outcome::Success, Reason::None));
  EXPECT_EQ(table.text(),
            "condition         trials  success  failure  aborted  interrupted  success_percent  reasons\n"
            "slow                   6        2        3        0            1             40.0  device_lost=1,position=1,velocity=2\n"
            "a long condition       1        0        0        1            0                -  no_onset=1\n"
            "fast                   1        1        0        0            0            100.0  -\n");
}

TEST(TrialLine, LeavesOutWhatDoesNotApply) {
  using trial::Outcome;
  using trial::Reason;
  EXPECT_EQ(trialLine(7, ended(Outcome::Success, Reason::None, 0, 0, 1.23456)), "trial=7 outcome=success time_s=1.235");
  EXPECT_EQ(trialLine(3, ended(Outcome::Failure, Reason::Velocity, 5, 0.0041234, 1.31)),
            "trial=3 outcome=failure reason=velocity mass=5 by=0.00412 by_unit=m/s time_s=1.310");
  EXPECT_EQ(trialLine(1, ended(Outcome::Failure, Reason::TimeShort, 1, -0.25, 1)),
            "trial=1 outcome=failure reason=time_short mass=1 by=-0.25 by_unit=s time_s=1.000");
  EXPECT_EQ(trialLine(2, ended(Outcome::Aborted, Reason::NoOnset)), "trial=2 outcome=aborted reason=no_onset time_s=0.000");
  EXPECT_EQ(trialLine(2, ended(Outcome::Aborted, Reason::ForceLimit, 0, 1.5, 0.5)),
            "trial=2 outcome=aborted reason=force_limit by=1.5 time_s=0.500")
      << "of no unit";
}

}  // namespace
}  // namespace reachlab::cli
