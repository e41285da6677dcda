#include "sim/record/replay.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/session/session_folder.h"
#include "tests/cli/program.h"
#include "tests/record/made_run.h"

namespace reachlab::cli {
namespace {

using test::printed;

class Replay : public InAFolder {};

TEST_F(Replay, OfEveryShippedExperimentIsBitIdentical) {
  for (const std::string& name : experiment::shippedExperiments()) {
    if (!experiment::readExperiment(name).task) continue;
    const std::string data = folder_ / name;
    printed("run " + name + " --device replay:" REACHLAB_SOURCE_DIR "/resources/reaches --trials 3 --fast --data " + data);
    const std::string log = session::recordedRuns({data}).at(0).path;
    printed("replay " + log + " --check");
    const record::Replay replay = record::replayRun(record::RunLog::open(log));
    EXPECT_EQ(replay.trials.size(), 3u) << name;
    EXPECT_GT(replay.rows, 100u) << name;
  }
}

TEST_F(Replay, OfSimulatedSubjectsAndOfRealTimeIsBitIdentical) {
  printed("run chain-moderate --device simulated --trials 3 --seed 4 --fast --every-tick --data " + data_);
  printed("run chain-fast --device simulated --trials 1 --seed 4 --data " + data_);
  for (const session::RunOnDisk& run : session::recordedRuns({data_})) printed("replay " + run.path + " --check");
}

// Years later, on another computer: the definition's file is gone, or says something else under the same name.
TEST_F(Replay, NeedsNoFileOfTheConstraintThatAnExperimentNames) {
  const std::string definition = folder_ / "own-eight.json", experiment = folder_ / "eight.json";
  const auto write = [](const std::string& file, const std::string& text) { std::ofstream(file) << text; };
  const auto eight = [](const char* x) {
    return std::string(R"json({"schema_version": 1, "name": "own-eight", "kind": "curve", "curve": [")json") + x +
           R"json(", "w_m*sin(phi)*cos(phi)", "0"], "shape": {"w_m": {"default": 0.1, "min": 0.02, "max": 0.4, "unit": "m"}},
             "domain": [0, "2*pi"], "periodic": true, "start": [0], "target": ["pi/2"]})json";
  };
  write(definition, eight("w_m*cos(phi)"));
  write(experiment, test::experimentOn(R"({"name": "own-eight", "shape": {"w_m": 0.12}})", test::reachFrom("0", "1.5", "1.5")));
  ::setenv("REACHLAB_CONSTRAINTS", std::filesystem::path(definition).parent_path().c_str(), 1);
  printed("run " + experiment + " --device simulated --trials 2 --seed 4 --fast --data " + data_);
  const std::string log = session::recordedRuns({data_}).at(0).path;
  printed("replay " + log + " --check");
  write(definition, eight("0.9*w_m*cos(phi)"));
  printed("replay " + log + " --check");  // the file has changed
  std::filesystem::remove(definition);
  printed("replay " + log + " --check");  // the file is gone
  printed("export " + data_ + " --format csv --out " + (folder_ / "tables").string());
  printed("analyze " + data_ + " --out " + (folder_ / "analysis").string());
  ::unsetenv("REACHLAB_CONSTRAINTS");
  const record::RunConfiguration recorded = record::RunLog::open(log).configuration();
  EXPECT_TRUE(holds(recorded.definitionText, "w_m*sin(phi)*cos(phi)"));
  EXPECT_THROW((void)experiment::parseExperiment(recorded.experimentText, "eight"), FaultError)
      << "without the definition it cannot be known";
  EXPECT_EQ(record::recordedExperiment(recorded).experiment().constraint.shape.at("w_m"), 0.12);
}

// What is gone cannot differ: without the note, a log that lost its end would count as a whole one.
TEST_F(Replay, SaysOfALogThatWasCutShortThatItIsNotAllOfTheRun) {
  printed("run dingwell --device simulated --trials 3 --seed 4 --fast --data " + data_);
  const std::string log = session::recordedRuns({data_}).at(0).path;
  std::uint64_t beginOfLast = 0;
  {
    record::LogReader reader(log);
    record::RecordView record;
    while (reader.next(record)) beginOfLast = record.offset;
  }
  for (const bool cut : {false, true}) {
    if (cut) std::filesystem::resize_file(log, beginOfLast);  // between two records, as a kill leaves it
    const test::Ended ended = test::reach("replay " + log + " --check");
    EXPECT_EQ(ended.exitCode, 0);
    EXPECT_EQ(bool{test::holds(ended.err, "not closed in order")}, cut) << ended.err;
  }
}

// The same log with one number of one row changed, every record good in itself.
TEST_F(Replay, NamesTheFirstStateThatDiffersAndExits1) {
  const std::string changed = folder_ / "changed_log.reach";
  printed("run dingwell --device simulated --trials 2 --seed 4 --fast --data " + data_);
  int samples = 0;
  record::copyLog(session::recordedRuns({data_}).at(0).path, changed, [&](record::RecordType type, std::vector<std::uint8_t>& payload) {
    if (type == record::RecordType::Samples && ++samples == 2) payload[payload.size() - 9] ^= 1;
    return true;
  });
  ASSERT_GE(samples, 2);
  const record::Replay replay = record::replayRun(record::RunLog::open(changed));
  EXPECT_EQ(replay.rowsThatDiffer, 1u);
  EXPECT_TRUE(holds(replay.firstDifference, "mass1"));
  EXPECT_EQ(test::reach("replay " + changed + " --check").exitCode, 1);
  printed("replay " + changed);  // only --check judges
}

}  // namespace
}  // namespace reachlab::cli
