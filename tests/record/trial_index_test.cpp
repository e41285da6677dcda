#include "sim/record/trial_index.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "sim/record/log/records.h"
#include "sim/record/log/whole_file.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

class IndexedTrials : public InAFolder {
 protected:
  // Two runs of which no two numbers or words are equal, the second broken off in its third trial.
  void writeTwoRuns() const {
    RunConfiguration c = madeConfiguration();
    c.subject = "11", c.session = "12", c.condition = "slow", c.experimentName = "made", c.device = "robot";
    c.run = 3, c.block = 4, c.day = 5, c.practice = true;
    c.startedUtc = "2026-11-20T10:00:00.000Z";
    writeMadeRun(first_, 2, c);
    c.condition = "";
    c.practice = false;
    c.run = 6;
    const std::string broken = data_ + "/b_log.reach";
    writeMadeRun(broken, 3, c);
    cutInTheLastTrialsRecord(broken);
  }
  const std::string file_ = folder_ / "an.index", first_ = data_ + "/a_log.reach";
};

TEST_F(IndexedTrials, KnowsOfARunWhatItsLogSaysWhetherReadOrKept) {
  writeTwoRuns();
  for (const std::size_t read : {2u, 0u}) {
    SCOPED_TRACE(read);
    std::size_t asked = 0;
    const TrialIndex index = openTrialIndex(data_, file_, [&](std::size_t, std::size_t) { return ++asked, true; });
    EXPECT_EQ(index.read, read);
    EXPECT_EQ(asked, read) << "for what is kept nobody is asked";
    ASSERT_EQ(index.runs.size(), 2u);
    EXPECT_EQ(index.trialCount(), 5u);
    const IndexedRun &a = index.runs[0], &b = index.runs[1];
    EXPECT_EQ(a.path, first_);
    EXPECT_EQ(a.bytes, std::filesystem::file_size(a.path));
    EXPECT_EQ(a.subject, "11");
    EXPECT_EQ(a.session, "12");
    EXPECT_EQ(a.condition, "slow");
    EXPECT_EQ(b.condition, "made") << "without one the experiment's name";
    EXPECT_EQ(a.experiment, "made");
    EXPECT_EQ(a.device, "robot");
    EXPECT_EQ(a.startedUtc, "2026-11-20T10:00:00.000Z");
    EXPECT_EQ(a.run, 3);
    EXPECT_EQ(b.run, 6);
    EXPECT_EQ(a.block, 4);
    EXPECT_EQ(a.day, 5);
    EXPECT_TRUE(a.practice);
    EXPECT_FALSE(b.practice);
    EXPECT_TRUE(a.healthy);
    EXPECT_FALSE(b.healthy);
    for (const IndexedRun& run : index.runs) {
      const RunLog log = RunLog::open(run.path);
      ASSERT_EQ(run.trials.size(), log.trials().size());
      for (std::size_t i = 0; i < run.trials.size(); ++i) {
        EXPECT_EQ(bytesOf(run.trials[i]), bytesOf(log.trials()[i])) << i;
        EXPECT_EQ(run.trials[i].offset, log.trials()[i].offset);
        EXPECT_EQ(run.trials[i].sequence, log.trials()[i].sequence);
        EXPECT_EQ(run.trials[i].complete, log.trials()[i].complete);
      }
    }
    EXPECT_FALSE(b.trials[2].complete);
  }
  writeMadeRun(data_ + "/c_log.reach", 1);
  EXPECT_EQ(openTrialIndex(data_, file_).read, 1u) << "only the new one";
  std::filesystem::remove(data_ + "/b_log.reach");
  const TrialIndex left = openTrialIndex(data_, file_);
  EXPECT_EQ(left.read, 0u);
  EXPECT_EQ(left.trialCount(), 2u + 1) << "what is gone is gone";
}

TEST_F(IndexedTrials, ALogOfAnotherTimeOrSizeIsReadAnew) {
  writeTwoRuns();
  EXPECT_EQ(openTrialIndex(data_, file_).read, 2u);
  std::filesystem::last_write_time(first_, std::filesystem::last_write_time(first_) - std::chrono::seconds(5));
  EXPECT_EQ(openTrialIndex(data_, file_).read, 1u);
  EXPECT_EQ(openTrialIndex(data_, file_).read, 0u);
  const auto time = std::filesystem::last_write_time(first_);
  std::filesystem::resize_file(first_, std::filesystem::file_size(first_) - 1);
  std::filesystem::last_write_time(first_, time);
  const TrialIndex shorter = openTrialIndex(data_, file_);
  EXPECT_EQ(shorter.read, 1u);
  EXPECT_FALSE(shorter.runs[0].healthy);
  EXPECT_EQ(openTrialIndex(data_, "").read, 2u) << "without a file all are read";
}

TEST_F(IndexedTrials, AsksBeforeEachLogThatItMustOpen) {
  writeTwoRuns();
  std::vector<std::pair<std::size_t, std::size_t>> asked;
  const TrialIndex index = openTrialIndex(data_, "", [&](std::size_t done, std::size_t of) {
    asked.emplace_back(done, of);
    return done < 1;
  });
  EXPECT_EQ(asked, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}, {1, 2}}));
  EXPECT_EQ(index.runs.size(), 1u) << "given up before the second";
}

TEST_F(IndexedTrials, EveryDatasetHasAFileOfItsOwn) {
  const std::string here = indexFileFor("/data/one", "/cache");
  EXPECT_TRUE(here.starts_with("/cache/") && here.ends_with(".index")) << here;
  EXPECT_EQ(here.size(), std::string("/cache/0123456789abcdef.index").size());
  EXPECT_EQ(indexFileFor("/data/./two/../one", "/cache"), here) << "the same folder by another way";
  EXPECT_NE(indexFileFor("/data/two", "/cache"), here);
}

TEST_F(IndexedTrials, ADamagedIndexFileIsAsGoodAsNone) {
  writeMadeRun(first_, 2);
  const TrialIndex whole = openTrialIndex(data_, file_);
  const std::string text = readWholeFile(file_);
  for (std::size_t at = 0; at < text.size(); at += 7) {
    std::string other = text;
    other[at] = static_cast<char>(other[at] ^ 0x41);
    std::ofstream(file_, std::ios::binary) << (at % 2 == 0 ? other : text.substr(0, at));
    const TrialIndex again = openTrialIndex(data_, file_);
    ASSERT_EQ(again.read, 1u) << "byte " << at;
    ASSERT_EQ(again.trialCount(), 2u) << "byte " << at;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(bytesOf(again.runs[0].trials[i]), bytesOf(whole.runs[0].trials[i])) << "byte " << at;
  }
}

TEST_F(IndexedTrials, ALogThatCannotBeReadIsLeftOutWithASentenceAndGivingUpKeepsTheFile) {
  writeMadeRun(first_, 1);
  std::ofstream(data_ + "/zz_log.reach") << "no log";
  const TrialIndex index = openTrialIndex(data_, "");
  EXPECT_EQ(index.runs.size(), 1u);
  ASSERT_EQ(index.unreadable.size(), 1u);
  EXPECT_TRUE(holds(index.unreadable[0], "zz_log.reach"));
  EXPECT_EQ(openTrialIndex(data_, file_, [](std::size_t, std::size_t) { return false; }).runs.size(), 0u);
  EXPECT_FALSE(std::filesystem::exists(file_)) << "half an index is none";
  EXPECT_THROW(openTrialIndex(folder_ / "nothing", file_), Error);
}

// Cut off in the fourth of six, as a power cut or a copy that was not finished leaves it.
TEST_F(IndexedTrials, NamesTheTrialsThatACutLogHasLost) {
  RunConfiguration c = madeConfiguration();
  for (int i = 0; i < 6; ++i) c.trials.push_back({i, 0, false});
  writeMadeRun(first_, 6, c);
  const std::vector<RecordedTrial> trials = RunLog::open(first_).trials();
  EXPECT_EQ(openTrialIndex(data_, file_).runs.at(0).loss, "") << "a whole log has lost nothing";
  std::filesystem::remove(first_);
  writeMadeRun(first_, 4, c);
  cutInTheLastTrialsRecord(first_);
  for (int again = 0; again < 2; ++again) {  // the second time with the index file
    const TrialIndex index = openTrialIndex(data_, file_);
    ASSERT_EQ(index.runs.size(), 1u);
    ASSERT_EQ(index.runs[0].trials.size(), 4u);
    EXPECT_FALSE(index.runs[0].trials[3].complete);
    const std::string& loss = index.runs[0].loss;
    EXPECT_TRUE(holds(loss, "Trial 4 broke off. The planned trials 5 and 6 are not in it."));
    EXPECT_TRUE(holds(loss, "reach recover " + first_));
  }
  std::filesystem::resize_file(first_, trials[1].offset - 1);
  EXPECT_TRUE(holds(openTrialIndex(data_, file_).runs.at(0).loss, "The planned trials 2 to 6 are not in it."));
}

}  // namespace
}  // namespace reachlab::record
