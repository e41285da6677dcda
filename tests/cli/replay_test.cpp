#include "sim/record/replay.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/experiment/experiment.h"
#include "sim/record/log.h"
#include "sim/session/session_folder.h"
#include "tests/record/made_run.h"

namespace reachlab {
namespace {

int reach(const std::string& arguments) {
  const int status = std::system(("\"" REACH_PROGRAM "\" " + arguments + " > /dev/null 2> /dev/null").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Replay, OfEveryShippedExperimentIsBitIdentical) {
  const TemporaryFolder folder("replay");
  for (const std::string& name : shippedExperiments()) {
    if (!readExperiment(name).task) continue;
    const std::string data = folder / name;
    ASSERT_EQ(
        reach("run " + name + " --device replay:" REACHLAB_SOURCE_DIR "/resources/reaches --trials 3 --fast --data " + data), 0)
        << name;
    const std::string log = recordedRuns({data}).at(0).path;
    EXPECT_EQ(reach("replay " + log + " --check"), 0) << name;
    const Replay replay = replayRun(RunLog::open(log));
    EXPECT_EQ(replay.trials.size(), 3u) << name;
    EXPECT_GT(replay.rows, 100u) << name;
  }
}

TEST(Replay, OfSimulatedSubjectsAndOfRealTimeIsBitIdentical) {
  const TemporaryFolder folder("replay2");
  const std::string data = folder / "data";
  ASSERT_EQ(reach("run chain-moderate --device simulated --trials 3 --seed 4 --fast --every-tick --data " + data), 0);
  ASSERT_EQ(reach("run chain-fast --device simulated --trials 1 --seed 4 --data " + data), 0);
  for (const RecordedRun& run : recordedRuns({data})) EXPECT_EQ(reach("replay " + run.path + " --check"), 0) << run.path;
}

// The same log with one number of one row changed, every record good in itself.
TEST(Replay, NamesTheFirstStateThatDiffersAndExits1) {
  const TemporaryFolder folder("replay3");
  const std::string data = folder / "data", changed = folder / "changed_log.reach";
  ASSERT_EQ(reach("run dingwell --device simulated --trials 2 --seed 4 --fast --data " + data), 0);
  {
    LogReader reader(recordedRuns({data}).at(0).path);
    LogWriter writer = LogWriter::create(changed);
    RecordView record;
    int samples = 0;
    while (reader.next(record)) {
      std::vector<std::uint8_t> payload(record.payload.begin(), record.payload.end());
      if (record.type == RecordType::Samples && ++samples == 2) payload[payload.size() - 9] ^= 1;
      writer.append(record.type, payload);
    }
    ASSERT_GE(samples, 2);
  }
  const Replay replay = replayRun(RunLog::open(changed));
  EXPECT_EQ(replay.rowsThatDiffer, 1u);
  EXPECT_NE(replay.firstDifference.find("mass1"), std::string::npos) << replay.firstDifference;
  EXPECT_EQ(reach("replay " + changed + " --check"), 1);
  EXPECT_EQ(reach("replay " + changed), 0) << "only --check judges";
}

}  // namespace
}  // namespace reachlab
