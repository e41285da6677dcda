#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <string>

#include "sim/record/run_log.h"
#include "sim/session/session_folder.h"
#include "tests/cli/program.h"
#include "tests/record/made_run.h"

// Two real stations on one machine, each with its endpoint.
namespace reachlab::cli {
namespace {

namespace fs = std::filesystem;

using test::Ended;
using test::reach;

class Stations : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(fs::path(REACH_PROGRAM).parent_path() / "reachlab-endpoint")) GTEST_SKIP() << "built without Cyclone DDS";
  }
  // A domain of its own for each test program that may run beside.
  static std::string common() {
    return "--interface lo --peer 127.0.0.1 --wait 40 --seed 1 --domain " + std::to_string(::getpid() % 200) + " ";
  }
  std::pair<Ended, Ended> both(const std::string& one, const std::string& other) {
    auto second = std::async(std::launch::async, [&] { return reach(other); });
    const Ended first = reach(one);
    return {first, second.get()};
  }
  std::string dataOf(const char* station) const { return folder_ / station; }
  record::RunLog logOf(const char* station) const { return record::RunLog::open(session::recordedRuns({dataOf(station)}).at(0).path); }
  const record::TemporaryFolder folder_{"stations"};
};

// In real time, by two processes: among the long checks (tests/long/stations.sh).
TEST_F(Stations, DISABLED_TwoMoveOneChainTogether) {
  const auto [left, right] = both("station chain-two-hands --number 1 --conductor --device simulated:noise=0 --trials 2 --insecure " + common() +
                                      "--data " + dataOf("left"),
                                  "station chain-two-hands --number 2 --device simulated:noise=0 --insecure " + common() + "--data " + dataOf("right"));
  ASSERT_EQ(left.exitCode, 0) << left.err << "\n--- right:\n" << right.err;
  ASSERT_EQ(right.exitCode, 0) << right.err;
  for (const char* station : {"left", "right"}) {
    const record::RunLog log = logOf(station);
    ASSERT_EQ(log.trials().size(), 2u) << station;
    for (const record::RecordedTrial& trial : log.trials()) EXPECT_NE(trial.result.reason, trial::Reason::PeerLost) << left.err << right.err;
    EXPECT_TRUE(log.healthy()) << station;
    // Each copy again, from its own log alone.
    const Ended replayed = reach("replay " + log.path() + " --check");
    EXPECT_EQ(replayed.exitCode, 0) << station << ": " << replayed.out << replayed.err;
  }
  // The last mass is the other's: it moved on this copy, too.
  const record::RunLog log = logOf("left");
  const record::SampleRows rows = log.allRows();
  const std::size_t last = log.configuration().table.indexOf("mass5_pos_x");
  double most = -1;
  for (std::size_t i = 0; i < rows.size(); ++i) most = std::max(most, rows.at(i, last));
  EXPECT_GT(most, 0.05);
}

TEST_F(Stations, OtherExperimentsAreNotArmed) {
  const std::string mine = folder_ / "mine.json";
  fs::copy(fs::path(REACHLAB_SOURCE_DIR) / "resources/experiments/two-hands/parallel-two-hands.json", mine);
  const std::string quick = "--interface lo --peer 127.0.0.1 --wait 6 --seed 1 --domain " + std::to_string((::getpid() + 1) % 200) + " --insecure ";
  const auto [left, right] = both("station chain-two-hands --number 1 --conductor --device simulated " + quick + "--data " + dataOf("left"),
                                  "station " + mine + " --number 2 --device simulated " + quick + "--data " + dataOf("right"));
  EXPECT_EQ(left.exitCode, 3) << left.err;
  EXPECT_NE(left.err.find("has another experiment"), std::string::npos) << left.err;
  EXPECT_TRUE(logOf("left").trials().empty());
}

// The tick at which the last sample of a peer came, from the records of them (network/line/station_line.cpp).
std::uint64_t lastHeardTick(const record::RunLog& log) {
  std::uint64_t last = 0;
  record::LogReader reader(log.path());
  record::RecordView record;
  while (reader.next(record)) {
    if (record.type != record::RecordType::PeerTicks) continue;
    record::ByteReader in(record.payload);
    const std::size_t count = in.get<std::uint32_t>();
    in.get<std::uint32_t>();  // whose log it is
    const std::size_t places = in.get<std::uint32_t>(), rates = in.get<std::uint32_t>();
    const std::size_t bytes = 8 + 4 + 8 + 4 + 8 + 48 + 8 + 8 * (places + rates);
    record::ByteReader newest(record.payload.subspan(16 + (count - 1) * bytes));
    last = newest.get<std::uint64_t>();
  }
  return last;
}

// In real time, by two processes: among the long checks (tests/long/stations.sh).
TEST_F(Stations, DISABLED_AKilledStationIsLostWithin150MillisecondsAndNoLogLosesARecord) {
  const std::string slow = folder_ / "slow.json";
  record::writeFileAtomically(slow, R"({ "schema_version": 1, "name": "slow", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "chain", "masses_kg": [0.6, 0.6], "stiffness_n_per_m": [600] }, "coupling": { "stiffness_n_per_m": 600, "damping_n_s_per_m": 5 },
  "hands": [{ "mass": 1 }, { "mass": 2 }], "timing": { "max_missed_ticks": 100000, "max_gap_s": 10 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 40, "tolerance": { "position_m": 0.01, "velocity_m_per_s": 0.01, "time_s": 1 } } })");
  auto second = std::async(std::launch::async, [&] {
    return std::system(("timeout -s KILL 15 \"" REACH_PROGRAM "\" station " + slow + " --number 2 --device simulated:noise=0 --insecure " + common() +
                        "--data " + dataOf("right") + " > /dev/null 2>&1").c_str());
  });
  const Ended left = reach("station " + slow + " --number 1 --conductor --device simulated:noise=0 --insecure " + common() + "--data " + dataOf("left"));
  second.get();
  const record::RunLog log = logOf("left");
  ASSERT_EQ(log.trials().size(), 1u) << left.err;
  const trial::TrialResult& result = log.trials()[0].result;
  EXPECT_EQ(result.outcome, trial::Outcome::Interrupted);
  EXPECT_EQ(result.reason, trial::Reason::PeerLost) << left.out << left.err;
  EXPECT_GE(result.endTick, lastHeardTick(log) + 100) << "it fades first";
  EXPECT_LE(result.endTick, lastHeardTick(log) + 150);
  EXPECT_EQ(reach("replay " + log.path() + " --check").exitCode, 0);
  // The one that was killed is whole up to its last block: the trial is there, broken off.
  const record::RunLog killed = logOf("right");
  ASSERT_EQ(killed.trials().size(), 1u);
  EXPECT_FALSE(killed.trials()[0].complete);
  EXPECT_GT(killed.ticks().size(), 1000u);
}

// In real time, by two processes: among the long checks (tests/long/stations.sh).
TEST_F(Stations, DISABLED_WithCertificatesTheyMeetAndAStrangerIsNotHeard) {
  ASSERT_EQ(reach("peers init " + (folder_ / "lab") + " --conductor --name left").exitCode, 0);
  ASSERT_EQ(reach("peers init " + (folder_ / "other") + " --name right").exitCode, 0);
  ASSERT_EQ(reach("peers add " + (folder_ / "lab") + " " + (folder_ / "other") + "/request.pem").exitCode, 0);
  for (const auto& entry : fs::directory_iterator(folder_ / "lab/for-right")) fs::copy(entry.path(), fs::path(folder_ / "other") / entry.path().filename());
  ASSERT_EQ(reach("peers init " + (folder_ / "stranger") + " --conductor --name right").exitCode, 0);
  const auto [left, right] =
      both("station chain-two-hands --number 1 --conductor --device simulated:noise=0 --peers " + (folder_ / "lab") + " " + common() + "--data " + dataOf("left"),
           "station chain-two-hands --number 2 --device simulated:noise=0 --peers " + (folder_ / "other") + " " + common() + "--data " + dataOf("right"));
  EXPECT_EQ(left.exitCode, 0) << left.err << "\n--- right:\n" << right.err;
  EXPECT_EQ(right.exitCode, 0) << right.err;
  const std::string quick = "--interface lo --peer 127.0.0.1 --wait 8 --seed 1 --domain " + std::to_string((::getpid() + 2) % 200) + " ";
  const auto [alone, stranger] =
      both("station chain-two-hands --number 1 --conductor --device simulated --peers " + (folder_ / "lab") + " " + quick + "--data " + dataOf("alone"),
           "station chain-two-hands --number 2 --device simulated --peers " + (folder_ / "stranger") + " " + quick + "--data " + dataOf("stranger"));
  EXPECT_EQ(alone.exitCode, 3) << alone.err;
  EXPECT_NE(alone.err.find("station 2: is not there"), std::string::npos) << alone.err;
  EXPECT_EQ(stranger.exitCode, 3) << stranger.err;
}

}  // namespace
}  // namespace reachlab::cli
