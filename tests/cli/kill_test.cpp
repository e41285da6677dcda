// kill -9 at seeded random moments. A few here; `tests/long/kill.sh` sets REACHLAB_KILLS to 200.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <thread>

#include "sim/record/log/whole_file.h"
#include "sim/record/recover.h"
#include "sim/record/replay.h"
#include "sim/session/session_folder.h"
#include "tests/cli/program.h"

namespace reachlab::cli {
namespace {

using Clock = std::chrono::steady_clock;

int killCount() {
  const char* asked = std::getenv("REACHLAB_KILLS");
  return asked != nullptr ? std::atoi(asked) : 6;
}

// Runs `reach`, and kills it `seconds` after it has printed so many lines; what it has printed.
std::string runAndKill(const std::string& arguments, double seconds, int afterLines = 0) {
  const TemporaryFolder folder;
  const std::string out = folder / "out";
  const int descriptor = ::open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  const pid_t child = test::start(test::split(arguments, ' '), descriptor);
  ::close(descriptor);
  const auto lines = [&] {
    const std::string text = test::contentOf(out);
    return std::count(text.begin(), text.end(), '\n');
  };
  bool ended = false;
  while (lines() < afterLines && !(ended = ::waitpid(child, nullptr, WNOHANG) != 0))
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  if (!ended) ::kill(child, SIGKILL), ::waitpid(child, nullptr, 0);
  return test::contentOf(out);
}

bool sameResult(const trial::TrialResult& a, const trial::TrialResult& b) {
  return a.outcome == b.outcome && a.reason == b.reason && a.mass == b.mass && a.by == b.by && a.movementTime == b.movementTime;
}

const std::string kRun = "run chain-moderate --device simulated --trials 30 --seed 11 --fast --data ";

class Kill : public InAFolder {};

TEST_F(Kill, LosesNoAnnouncedTrialAndResumesWithTheSameOrder) {
  const std::string whole = folder_ / "whole";
  test::printed(kRun + whole);
  const record::RunLog good = record::RunLog::open(session::recordedRuns({whole}).at(0).path);
  ASSERT_EQ(good.trials().size(), 30u);

  std::mt19937_64 random(6);
  for (int k = 0; k < killCount(); ++k) {
    const std::string data = folder_ / ("kill" + std::to_string(k));
    const int after = static_cast<int>(random() % 30);
    const double moment = static_cast<double>(random() % 8000) * 1e-6;  // a trial takes a few milliseconds on the virtual clock
    const std::string out = runAndKill(kRun + data, moment, after);
    const auto lines = test::trialLines(out.substr(0, out.rfind('\n') + 1));  // without the last one where it was cut
    const std::vector<session::RunOnDisk> runs = session::recordedRuns({data});
    if (runs.empty()) {
      EXPECT_TRUE(lines.empty());
      continue;
    }
    if (std::filesystem::file_size(runs[0].path) < 1000) {  // before the configuration was on the disk
      EXPECT_TRUE(lines.empty());
      std::filesystem::remove(runs[0].path);
      continue;
    }
    const record::RunLog log = record::RunLog::open(runs[0].path);
    std::size_t finished = 0;
    for (const record::RecordedTrial& trial : log.trials()) {
      if (trial.complete) {
        EXPECT_TRUE(sameResult(trial.result, good.trials()[finished].result)) << "kill " << k << ", trial " << trial.trial;
        ++finished;
      } else {
        EXPECT_EQ(trial.result.outcome, trial::Outcome::Interrupted);
      }
    }
    EXPECT_GE(finished, lines.size()) << "kill " << k;
    EXPECT_TRUE(record::replayRun(log).identical()) << "kill " << k << ": " << record::replayRun(log).firstDifference;

    // What is left of the order is done by --resume, with the results that the unbroken run has.
    test::printed(kRun + data + " --resume");
    std::map<int, trial::TrialResult> done;
    for (const session::RunOnDisk& run : session::recordedRuns({data})) {
      const record::RunLog part = record::RunLog::open(run.path);
      for (const record::RecordedTrial& trial : part.trials())
        if (trial.result.outcome != trial::Outcome::Interrupted) {
          EXPECT_FALSE(done.contains(trial.trial)) << "trial " << trial.trial << " was done twice";
          done[trial.trial] = trial.result;
        }
    }
    ASSERT_EQ(done.size(), 30u) << "kill " << k;
    for (const record::RecordedTrial& trial : good.trials())
      EXPECT_TRUE(sameResult(done.at(trial.trial), trial.result)) << "trial " << trial.trial;

    EXPECT_NO_THROW(record::recoverLog(runs[0].path));
    const record::RunLog mended = record::RunLog::open(runs[0].path);
    EXPECT_TRUE(mended.healthy());
    EXPECT_EQ(mended.trials().size(), log.trials().size());
    std::filesystem::remove_all(data);
    if (HasFailure()) return;
  }
}

TEST_F(Kill, OfAnExportLeavesTheLogAsItWasAndNoHalfFile) {
  const std::string out = folder_ / "out";
  test::printed(kRun + data_);
  const std::string log = session::recordedRuns({data_}).at(0).path;
  const std::string bytes = record::readWholeFile(log);
  const std::string arguments = "export " + log + " --format csv --out " + out;
  const auto start = Clock::now();
  test::printed(arguments);
  const double length = std::chrono::duration<double>(Clock::now() - start).count();
  std::map<std::string, std::string> whole;
  for (const auto& entry : std::filesystem::directory_iterator(out))
    whole[entry.path().filename().string()] = record::readWholeFile(entry.path().string());
  ASSERT_EQ(whole.size(), 4u) << "trials and samples, each with its dictionary";
  std::mt19937_64 random(7);
  for (int k = 0; k < killCount(); ++k) {
    std::filesystem::remove_all(out);
    runAndKill(arguments, length * static_cast<double>(random() % 1000) / 1000);
    EXPECT_EQ(record::readWholeFile(log), bytes);
    if (!std::filesystem::exists(out)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(".reachlab-tmp")) continue;  // under its own name a file is whole or not there
      EXPECT_EQ(record::readWholeFile(entry.path().string()), whole[name]) << name;
    }
  }
}

}  // namespace
}  // namespace reachlab::cli
