#include "sim/record/trial_index.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "sim/record/log/whole_file.h"
#include "tests/analysis/recorded.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

TEST(TrialIndex, ADamagedIndexFileIsAsGoodAsNone) {
  const TemporaryFolder folder;
  const std::string data = folder.path() + "/data", file = folder.path() + "/an.index";
  analysis::recordRun(data, {.experiment = "chain-moderate", .trials = 2});
  const TrialIndex whole = openTrialIndex(data, file);
  const std::string text = readWholeFile(file);
  for (std::size_t at = 0; at < text.size(); at += 7) {
    std::string other = text;
    other[at] = static_cast<char>(other[at] ^ 0x41);
    std::ofstream(file, std::ios::binary) << (at % 2 == 0 ? other : text.substr(0, at));
    const TrialIndex again = openTrialIndex(data, file);
    ASSERT_EQ(again.read, 1u) << "byte " << at;
    ASSERT_EQ(again.trialCount(), 2u) << "byte " << at;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(bytesOf(again.runs[0].trials[i]), bytesOf(whole.runs[0].trials[i])) << "byte " << at;
  }
}

TEST(TrialIndex, ALogThatCannotBeReadIsLeftOutWithASentenceAndGivingUpKeepsTheFile) {
  const TemporaryFolder folder;
  const std::string data = folder.path() + "/data", file = folder.path() + "/an.index";
  analysis::recordRun(data, {.experiment = "chain-moderate", .trials = 1});
  std::ofstream(data + "/sourcedata/zz_log.reach") << "no log";
  const TrialIndex index = openTrialIndex(data, "");
  EXPECT_EQ(index.runs.size(), 1u);
  ASSERT_EQ(index.unreadable.size(), 1u);
  EXPECT_NE(index.unreadable[0].find("zz_log.reach"), std::string::npos);
  EXPECT_EQ(openTrialIndex(data, file, [](std::size_t, std::size_t) { return false; }).runs.size(), 0u);
  EXPECT_FALSE(std::filesystem::exists(file)) << "half an index is none";
  EXPECT_THROW(openTrialIndex(folder.path() + "/nothing", file), Error);
}

// Cut off in the fourth of six, as a power cut or a copy that was not finished leaves it.
TEST(TrialIndex, NamesTheTrialsThatACutLogHasLost) {
  const TemporaryFolder folder;
  const std::string data = folder.path() + "/data", file = folder.path() + "/an.index";
  const std::string log = analysis::recordRun(data, {.experiment = "chain-moderate", .trials = 6});
  const std::vector<RecordedTrial> trials = RunLog::open(log).trials();
  EXPECT_EQ(openTrialIndex(data, file).runs.at(0).loss, "") << "a whole log has lost nothing";
  std::filesystem::resize_file(log, (trials[3].offset + trials[4].offset) / 2);
  for (int again = 0; again < 2; ++again) {  // the second time with the index file
    const TrialIndex index = openTrialIndex(data, file);
    ASSERT_EQ(index.runs.size(), 1u);
    ASSERT_EQ(index.runs[0].trials.size(), 4u);
    EXPECT_FALSE(index.runs[0].trials[3].complete);
    const std::string& loss = index.runs[0].loss;
    EXPECT_NE(loss.find("Trial 4 broke off. The planned trials 5 and 6 are not in it."), std::string::npos) << loss;
    EXPECT_NE(loss.find("reach recover " + log), std::string::npos) << loss;
  }
  std::filesystem::resize_file(log, trials[1].offset - 1);
  EXPECT_NE(openTrialIndex(data, file).runs.at(0).loss.find("The planned trials 2 to 6 are not in it."), std::string::npos)
      << openTrialIndex(data, file).runs.at(0).loss;
}

}  // namespace
}  // namespace reachlab::record
