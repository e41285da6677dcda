// A disk that takes no more: RLIMIT_FSIZE makes every write beyond a size fail, without a file system of one's own.
// `tests/long/disk.sh` does the same with small, read-only and yanked tmpfs.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/record/log/run_log.h"
#include "sim/session/session_folder.h"
#include "tests/cli/program.h"

namespace reachlab::cli {
namespace {

// A run of 50 trials of which no file grows beyond so many kilobytes.
test::Ended runWithFileLimit(const std::string& data, int kilobytes) {
  return test::shell("ulimit -f " + std::to_string(kilobytes) +
                     "\n\"$REACH\" run chain-moderate --device simulated --trials 50 --seed 1 --fast --data " + data);
}

class FullDisk : public InAFolder {};

TEST_F(FullDisk, StopsTheRunWithOneSentenceAndExitCode3AndKeepsEveryAnnouncedTrial) {
  for (const int limit : {400, 1000, 2222}) {
    const std::string data = folder_ / std::to_string(limit);
    const test::Ended ending = runWithFileLimit(data, limit);
    EXPECT_TRUE(says(ending, 3, "_log.reach"));
    const std::size_t announced = test::trialLines(ending.out).size();
    EXPECT_GE(announced, 1u);
    EXPECT_LT(announced, 50u);
    const record::RunLog log = record::RunLog::open(session::recordedRuns({data}).at(0).path);
    const auto finished =
        std::count_if(log.trials().begin(), log.trials().end(), [](const record::RecordedTrial& trial) { return trial.complete; });
    EXPECT_GE(static_cast<std::size_t>(finished), announced);
    EXPECT_EQ(log.goodBytes(), log.fileBytes()) << "what was written in part is cut off again";
  }
}

// Such a log took a run's number, and every later command warned of it.
TEST_F(FullDisk, LeavesNoLogOfARunThatCouldNotBegin) {
  for (const int limit : {0, 1}) {
    const std::string data = folder_ / std::to_string(limit);
    const std::filesystem::path sources = std::filesystem::path(data) / "sourcedata";
    std::filesystem::create_directories(sources);
    EXPECT_EQ(runWithFileLimit(data, limit).exitCode, 3);
    for (const auto& entry : std::filesystem::directory_iterator(sources)) EXPECT_FALSE(holds(entry.path().string(), "_log.reach"));
    EXPECT_TRUE(session::recordedRuns({data}).empty());
  }
}

}  // namespace
}  // namespace reachlab::cli
