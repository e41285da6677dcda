// No number and no file crashes, hangs or fills the memory: every size has a bound, and the refusal names it.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/cli/program.h"

using namespace reachlab::test;
namespace fs = std::filesystem;

class Bounds : public InAFolder {};

TEST_F(Bounds, OfTimesAndCountsOnTheCommandLine) {
  const std::string predict = "predict dingwell --criterion min-hand-jerk ";
  for (const char* duration : {"1e20", "1e8", "3601"}) EXPECT_TRUE(says(reach(predict + "--duration " + duration), 2, "0.001 to 3600 s"));
  EXPECT_TRUE(says(reach(predict + "--samples 2000000000"), 2, "2 to 1000000"));
  EXPECT_TRUE(says(reach("simulate dingwell --hand hold --until 1e9"), 2, "--until: 1000000000 s are too many rows"));
  EXPECT_TRUE(says(reach("simulate dingwell --hand hold --every 1e-300"), 2, "too many rows"));
}

TEST_F(Bounds, OfAnExperimentsTimes) {
  for (const char* duration : {"1e308", "3601", "0", "-1"}) {
    const std::string file = folder_.write("e.json", experimentOn(R"({"name": "line"})", reachFrom("0", "6.28", duration)));
    for (const std::string& command : {"validate " + file, "run " + file + " --device simulated --fast --data " + data_,
                                       "predict " + file + " --criterion min-hand-jerk"})
      EXPECT_TRUE(says(reach(command), 2, "task.duration_s: is"));
  }
  EXPECT_EQ(reach("validate " + folder_.write("e.json", experimentOn(R"({"name": "line"})", reachFrom("0", "6.28", "3600")))).exitCode, 0);
}

// A hundred and sixty times round a torus, and a mass that swings a thousand times on its way: each took many seconds, or gigabytes.
TEST_F(Bounds, OfWhatAPredictionMayCost) {
  std::string torus = contentOf(std::string(REACHLAB_SOURCE_DIR) + "/resources/experiments/torus.json");
  const std::size_t target = torus.find("\"target\": [") + 11;
  torus.replace(target, torus.find(',', target) - target, "1000");
  const std::string words[] = {"multiplications, which is what a prediction may cost", "numbers at once\nhelp: allowed"};
  const std::string swinging = R"("kind": "chain", "masses_kg": [1, 0.01], "stiffness_n_per_m": [1e5])";
  const std::string experiments[] = {
      folder_.write("round.json", torus),
      folder_.write("far.json", experimentOn(R"({"name": "ellipse"})", reachFrom("0.2", "3", "1.5"), swinging))};
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(says(reach("predict " + experiments[i] + " --criterion min-hand-jerk"), 4, words[i]));
  }
  EXPECT_TRUE(says(reach("predict dingwell --criterion min-torque-change --unknowns 2000000000"), 4, words[1]));
}

TEST_F(Bounds, OfSeeds) {
  for (const char* seed : {"-1", "18446744073709551616", "1e3", "0x10", "1.5", "+1"}) {
    EXPECT_TRUE(
        says(reach("run dingwell --device simulated --fast --data " + folder_.path() + " --seed=" + seed), 2, "18446744073709551615"))
        << seed;
  }
  const Ended largest = reach("run dingwell --device simulated --fast --seed 18446744073709551615 --data " + folder_.path());
  EXPECT_EQ(largest.exitCode, 0) << largest.err;
}

TEST_F(Bounds, AFileThatNeverEndsOrNeverBeginsIsRefused) {
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& file : {pipe, std::string("/dev/zero")}) {
    for (const std::string& command :
         std::vector<std::string>{"validate ", "simulate dingwell --hand ", "constraint check ", "export --format csv ", "replay ",
                                  "recover ", "run dingwell --fast --data " + data_ + " --device replay:"}) {
      const Ended ended = shell("timeout 60 \"$REACH\" " + command + file);
      EXPECT_TRUE(ended.exitCode == 2 || ended.exitCode == 3) << command << file << " " << ended.exitCode;
      EXPECT_NE(ended.err, "") << command << file;
    }
  }
}

// Were the cost not in proportion to the size, two million numbers would take days, and the test its time-out.
TEST_F(Bounds, ALargeFileIsReadInTimeInProportionToItsSize) {
  std::string numbers = "{\"schema_version\": [", keys = "{";
  for (int i = 0; i < 2'000'000; ++i) numbers += i == 0 ? "1.25" : ",1.25";
  for (int i = 0; i < 500'000; ++i) keys += (i == 0 ? "\"k" : ",\n\"k") + std::to_string(i) + "\": 1";
  EXPECT_TRUE(says(reach("validate " + folder_.write("numbers.json", numbers + "]}")), 2, "schema_version: is an array"));
  const Ended many = reach("validate " + folder_.write("keys.json", keys + "}"));
  EXPECT_TRUE(says(many, 2, "more faults"));
  EXPECT_LT(many.err.size(), 200'000u) << "nobody reads half a million faults";
  EXPECT_TRUE(says(reach("validate " + folder_.write("large.json", "{\"a\": \"" + std::string(17'000'000, 'x') + "\"}")), 2,
                   "allowed: up to 16777216"));
}

TEST(Tables, ATextThatASpreadsheetWouldCarryOutIsGuarded) {
  const TemporaryFolder folder, csv;
  ASSERT_EQ(reach("run dingwell --device simulated --seed 1 --fast --notes \"=cmd|' /C calc'!A0\" --data " + folder.path()).exitCode, 0);
  ASSERT_EQ(reach("export " + folder.path() + " --format csv --out " + csv.path()).exitCode, 0);
  const std::string table = contentOf(csv / "trials.csv");
  EXPECT_TRUE(holds(table, "\"'=cmd|' /C calc'!A0\""));
}

TEST(Resume, IsRefusedWhileTheRunIsBeingRecordedAndNamesItsProcess) {
  const TemporaryFolder data;
  const std::string log = (data / "sourcedata/sub-01_ses-01_task-chainmoderate_run-01_log.reach").string();
  const Ended ended = shell("\"$REACH\" run chain-moderate --device simulated --seed 1 --trials 30 --data " + data.path() +
                            " > /dev/null 2>&1 &\nrecording=$!\nfor i in $(seq 500); do [ -s " + log + " ] && break; sleep 0.02; done\n" +
                            "echo process $recording\n\"$REACH\" run chain-moderate --device simulated --resume --fast --data " +
                            data.path() + "\ncode=$?\nkill -INT $recording\nwait $recording\nexit $code");
  EXPECT_TRUE(says(ended, 3, "is being recorded (" + ended.out.substr(0, ended.out.find('\n')) + ")")) << ended.out;
}
