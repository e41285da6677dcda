// A disk that takes no more: RLIMIT_FSIZE makes every write beyond a size fail, without a file system of one's own.
// `tests/long/disk.sh` does the same with small, read-only and yanked tmpfs.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/record/log/whole_file.h"
#include "sim/session/session_folder.h"
#include "test_paths.h"
#include "tests/record/made_run.h"

namespace reachlab::cli {
namespace {

struct Ending {
  int exitCode = -1;
  std::string out, err;
};

Ending runWithFileLimit(const std::string& data, const std::string& folder, rlim_t bytes) {
  const std::string out = folder + ".out", err = folder + ".err";
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{bytes, bytes};
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 1);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), 2);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::execl(REACH_PROGRAM, REACH_PROGRAM, "run", "chain-moderate", "--device", "simulated", "--trials", "50", "--seed", "1", "--fast",
            "--data", data.c_str(), nullptr);
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, record::readWholeFile(out), record::readWholeFile(err)};
}

std::size_t linesThatBegin(const std::string& text, const std::string& with) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(with, at)) != std::string::npos; at += with.size()) count += at == 0 || text[at - 1] == '\n';
  return count;
}

TEST(FullDisk, StopsTheRunWithOneSentenceAndExitCode3AndKeepsEveryAnnouncedTrial) {
  const TemporaryFolder folder;
  for (const rlim_t limit : {400'000u, 1'000'000u, 2'222'222u}) {
    const std::string data = folder / std::to_string(limit);
    const Ending ending = runWithFileLimit(data, data, limit);
    EXPECT_EQ(ending.exitCode, 3) << ending.err;
    EXPECT_NE(ending.err.find("_log.reach"), std::string::npos) << ending.err;
    const std::size_t announced = linesThatBegin(ending.out, "trial=");
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
TEST(FullDisk, LeavesNoLogOfARunThatCouldNotBegin) {
  const TemporaryFolder folder;
  for (const rlim_t limit : {10u, 1000u}) {
    const std::string data = folder / std::to_string(limit);
    const std::filesystem::path sources = std::filesystem::path(data) / "sourcedata";
    std::filesystem::create_directories(sources);
    EXPECT_EQ(runWithFileLimit(data, data, limit).exitCode, 3);
    for (const auto& entry : std::filesystem::directory_iterator(sources))
      EXPECT_EQ(entry.path().string().find("_log.reach"), std::string::npos);
    EXPECT_TRUE(session::recordedRuns({data}).empty());
  }
}

}  // namespace
}  // namespace reachlab::cli
