// Ctrl-C, a terminal that goes and a polite kill: the program ends within a second, at any stage, and what was recorded is whole.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/cli/program.h"

using namespace reachlab::test;
namespace fs = std::filesystem;

namespace {

struct Stopped {
  int exitCode = -1;
  double seconds = 0;  // from the signal to the end, judged only against being stuck
};

// Starts `reach`, waits until `file` is there and then so many milliseconds, and sends the signal.
Stopped stop(const std::vector<std::string>& arguments, int signal, const fs::path& file, int milliseconds) {
  const pid_t child = start(arguments);
  const auto isThere = [&] { return file.empty() || (fs::exists(file) && !fs::is_empty(file)); };
  for (int i = 0; i < 2000 && !isThere(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  const auto begin = std::chrono::steady_clock::now();
  ::kill(child, signal);
  int status = 0;
  for (int i = 0; i < 3000 && ::waitpid(child, &status, WNOHANG) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (::kill(child, 0) == 0) ::kill(child, SIGKILL), ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()};
}

std::string longChain(const TemporaryFolder& folder, int masses) {
  std::string mass = "0.001", spring = "60000";
  for (int i = 1; i < masses; ++i) mass += ",0.001";
  for (int i = 2; i < masses; ++i) spring += ",60000";
  return folder.write("long.json", R"({"schema_version":1,"constraint":{"name":"line","shape":{"length_m":0.2}},
    "object":{"kind":"chain","masses_kg":[)" +
                                       mass + R"(],"stiffness_n_per_m":[)" + spring + R"(]},
    "coupling":{"stiffness_n_per_m":600,"damping_n_s_per_m":0},
    "task":{"start":[0],"target":[6.2],"duration_s":10,"tolerance":{"position_m":0.012,"velocity_m_per_s":0.012,"time_s":0.5}}})");
}

}  // namespace

TEST(Signals, EndARunWithTheTrialMarkedAndTheLogClosed) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const TemporaryFolder data, copy;
    const std::string log = "sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach";
    const Stopped ended = stop({"run", "chain-moderate", "--device", "simulated", "--trials", "50", "--seed", "1", "--timing-check", "0",
                                "--data", data.path(), "--backup", copy.path()},
                               signal, data / log, 700);
    EXPECT_EQ(ended.exitCode, code);
    const Table trials = exportedTrials(data.path());
    ASSERT_FALSE(trials.rows.empty());
    EXPECT_EQ(trials.rows.back()[trials.column("outcome")], "interrupted");
    EXPECT_EQ(trials.rows.back()[trials.column("complete")], "1");
    EXPECT_EQ(contentOf(copy / log), contentOf(data / log)) << "the second folder has the run that broke off, too";
  }
}

TEST(Signals, EndTheLongPlanningOfASimulatedHand) {
  const TemporaryFolder folder;
  const std::string experiment = longChain(folder, 500);
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const Stopped ended =
        stop({"run", experiment, "--device", "simulated", "--trials", "2", "--seed", "1", "--fast", "--data", folder / "data"}, signal, {},
             1500);
    EXPECT_EQ(ended.exitCode, code);
    EXPECT_LT(ended.seconds, 20) << "it was stuck";
  }
}

TEST(Signals, EndAnyOtherCommandWithTheirNumber) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}, {SIGHUP, 129}}) {
    const Stopped ended = stop({"simulate", "torus", "--hand", "hold", "--until", "9000", "--every", "1"}, signal, {}, 500);
    EXPECT_EQ(ended.exitCode, code);
  }
}
