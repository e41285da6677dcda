// What is typed is what is meant, and nothing is written over what is read.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/program.h"

using namespace reachlab::test;

namespace {

class Inputs : public InAFolder {};

TEST_F(Inputs, AnEmptyValueIsRefusedByItsOptionsName) {
  const std::string run = "cd " + folder_.path() + " && $REACH run dingwell --device simulated --fast --trials 1 --seed 1 ";
  for (const char* option : {"--data \"\"", "--backup \"\"", "--subject=", "--notes \"\""}) {
    const Ended ended = shell(run + option);
    EXPECT_TRUE(says(ended, 2, std::string(option, std::string_view(option).find_first_of(" =")) + ": is empty"));
  }
  EXPECT_EQ(reach("simulate \"\" --hand none").exitCode, 2);
}

TEST_F(Inputs, AWholeNumberIsReadInDecimal) {
  const auto run = [&](const std::string& options) {
    return printed("run dingwell --device simulated --fast --data " + folder_.path() + " " + options);
  };
  EXPECT_EQ(trialLines(run("--seed 1 --trials 010")).size(), 10u);
  EXPECT_EQ(run("--seed 010 --trials 2"), run("--seed 10 --trials 2"));
}

TEST_F(Inputs, AWholeNumberThatADoubleWouldRoundIsRefused) {
  const std::string plan = R"({"schema_version": 1, "order_seed": )", rest = R"(, "blocks": [{"experiment": "dingwell", "trials": 1}]})";
  EXPECT_EQ(reach("validate " + folder_.write("a.json", plan + "9007199254740992" + rest)).exitCode, 0);
  EXPECT_TRUE(says(reach("validate " + folder_.write("b.json", plan + "9007199254740993" + rest)), 2,
                   "order_seed: is 9007199254740993, which would be rounded"));
}

TEST_F(Inputs, DayZeroIsNoDay) {
  EXPECT_TRUE(
      says(reach("run paper --device simulated --fast --seed 1 --session 0 --data " + folder_.path()), 2, "--session: \"0\" is day 0"));
}

class Outputs : public InAFolder {};

TEST_F(Outputs, AreNeitherAnInputNorARecordingNorAmongThem) {
  ASSERT_EQ(reach("run dingwell --device simulated --fast --trials 1 --seed 1 --data " + data_).exitCode, 0);
  std::string log;
  for (const auto& entry : std::filesystem::directory_iterator(data_ + "/sourcedata"))
    if (entry.path().string().ends_with("_log.reach")) log = entry.path();
  const std::string mine =
      folder_.write("e.json", contentOf(std::filesystem::path(REACHLAB_SOURCE_DIR) / "resources/experiments/chain-slow.json"));
  const std::string before = contentOf(mine), recorded = contentOf(log);
  const std::string predict = "predict " + mine + " --criterion min-hand-jerk ",
                    simulate = "simulate " + mine + " --hand none --until 0.01 ";
  std::filesystem::create_symlink(log, folder_ / "link");
  for (const std::string& line :
       {predict + "--out " + mine, predict + "--out " + folder_.path() + "/./e.json", simulate + "--out " + log,
        simulate + "--out " + (folder_ / "link").string(), simulate + "--out " + (folder_ / "new_log.reach").string(),
        simulate + "--out " + data_ + "/sourcedata/rows.csv", "show " + log + " --trial 1 --figure " + data_ + "/sourcedata/f.svg",
        "export " + log + " --format csv --out " + data_ + "/sourcedata", "analyze " + data_ + " --out " + data_,
        "run dingwell --device simulated --fast --trials 1 --seed 1 --data " + data_ + "/sourcedata"}) {
    EXPECT_TRUE(says(reach(line), 2, "are not written over")) << line;
  }
  EXPECT_EQ(contentOf(mine), before);
  EXPECT_EQ(contentOf(log), recorded);
  EXPECT_EQ(reach(predict + "--out " + (folder_ / "fine.csv").string()).exitCode, 0);
}

// The log's reader refuses names beyond what file names hold; so does whoever would write it.
TEST_F(Outputs, ThatCouldNotBeReadAgainAreRefusedBeforeTheFirstTrial) {
  const std::string text = contentOf(std::filesystem::path(REACHLAB_SOURCE_DIR) / "resources/experiments/dingwell.json");
  const std::string file = folder_.write(std::string(61, 'a') + ".json", text), fine = folder_.write(std::string(60, 'a') + ".json", text);
  const std::string plan =
      folder_.write("long.json", R"({"schema_version": 1, "blocks": [{"experiment": "dingwell", "trials": 1, "pause_s": 1e7}]})");
  std::string hands = contentOf(std::filesystem::path(REACHLAB_SOURCE_DIR) / "resources/experiments/two-hands/chain-two-hands.json");
  const std::string line = R"("name": "line", "shape": { "length_m": 0.2 })";
  hands.replace(hands.find(line), line.size(), R"("name": "cycloid")");
  folder_.write("cusp.json", hands);
  const std::string cusp = folder_.write(
      "cusps.json", R"({"schema_version": 1, "trials": 1, "blocks": [{"experiment": "dingwell"}, {"experiment": "cusp.json"}]})");
  for (const std::string& refused : {file, plan, cusp})
    for (const std::string& command : {"validate " + refused, "run " + refused + " --device simulated --fast --seed 1 --data " + data_}) {
      const Ended ended = reach(command);
      EXPECT_EQ(ended.exitCode, 2) << command << ended.err;
      EXPECT_EQ(trialLines(ended.out).size(), 0u) << ended.out;
    }
  EXPECT_FALSE(std::filesystem::exists(data_));
  EXPECT_EQ(reach("run " + fine + " --device simulated --fast --seed 1 --data " + data_).exitCode, 0);
  EXPECT_EQ(reach("show " + data_).exitCode, 0);
}

// No permission, and links in a loop: as root, only the second is to be had.
TEST_F(Inputs, APlaceThatCannotBeLookedUpIsNotSaidToBeMissing) {
  const std::string loop = folder_ / "loop";
  std::filesystem::create_symlink("loop", loop);
  for (const char* command :
       {"validate ", "predict --criterion min-hand-jerk ", "show ", "export --format csv ", "analyze ", "study report "}) {
    const Ended ended = reach(command + loop + "/e.json");
    EXPECT_TRUE(says(ended, 3, loop + "/e.json")) << command;
    EXPECT_TRUE(says(ended, 3, ": cannot be read: Too many levels of symbolic links")) << command;
  }
}

TEST_F(Outputs, ThatCannotBeWrittenAreNamedWithTheReason) {
  for (const char* command : {"predict dingwell --criterion min-hand-jerk --out ", "predict dingwell --criterion min-hand-jerk --figure ",
                              "simulate dingwell --hand none --until 0.1 --out ", "stability omni --out "}) {
    EXPECT_TRUE(says(reach(command + std::string("/proc/none/x.svg")), 3, "No such file or directory")) << command;
  }
}

TEST_F(Outputs, OfALibraryOnAFullDiskEndInOneSentenceAndLeaveNothing) {
  ASSERT_EQ(reach("run dingwell --device simulated --fast --seed 1 --trials 8 --data " + data_).exitCode, 0);
  for (const char* format : {"hdf5", "mat"}) {
    const std::string out = folder_ / format;
    const Ended ended = shell("ulimit -f 40; $REACH export " + data_ + " --format " + format + " --out " + out);
    EXPECT_TRUE(says(ended, 3, "error: ")) << format;
    EXPECT_EQ(ended.err.find("error: "), ended.err.rfind("error: ")) << format << ended.err;
    EXPECT_TRUE(std::filesystem::is_empty(out)) << format;
  }
}

// Of three masses, so that everything that computes with an object has something to do.
std::string chainOf(double mass, double stiffness, double handMass) {
  return fmt::format(
      R"({{"schema_version": 1, "constraint": {{"name": "line"}}, "object": {{"kind": "chain", "masses_kg": [{0}, 1, {0}],
      "stiffness_n_per_m": [{1}, {1}]}}, "coupling": {{"stiffness_n_per_m": 600}}, "hand_mass_kg": {2}, "task": {{"start": [0], "target": [3],
      "duration_s": 1, "tolerance": {{"position_m": 0.012, "velocity_m_per_s": 0.012, "time_s": 0.5}}}}}})",
      mass, stiffness, handMass);
}

class Limits : public InAFolder {};

TEST_F(Limits, NumbersInWhichNoMethodWasTestedAreRefusedByTheirKey) {
  struct Case {
    double mass, stiffness, handMass;
    const char* key;
  };
  for (const auto& [mass, stiffness, handMass, key] : {Case{1e-300, 600, 1, "object.masses_kg[0]"},
                                                       {5e-324, 600, 1, "object.masses_kg[0]"},
                                                       {0.9e-6, 600, 1, "object.masses_kg[0]"},
                                                       {1.1e6, 600, 1, "object.masses_kg[0]"},
                                                       {1, 1e300, 1, "object.stiffness_n_per_m[0]"},
                                                       {1, 600, 1e300, "hand_mass_kg"}}) {
    const std::string file = folder_.write("e.json", chainOf(mass, stiffness, handMass));
    for (const std::string& line :
         {"validate " + file, "predict " + file + " --criterion min-hand-jerk", "simulate " + file + " --hand hold",
          "run " + file + " --device simulated --fast --seed 1 --data " + folder_.path()}) {
      EXPECT_TRUE(says(reach(line), 2, key)) << line;
    }
  }
  EXPECT_EQ(reach("predict chain-slow --criterion min-hand-jerk --hand-mass 1e-100").exitCode, 2);
  EXPECT_EQ(reach("run chain-slow --device simulated:hand-mass=1e-100 --fast --seed 1 --data " + folder_.path()).exitCode, 2);
}

// At the limits a computation may be refused, but it ends.
TEST_F(Limits, AtThemEveryCommandEnds) {
  for (const double mass : {1e-6, 1e6})
    for (const double stiffness : {0.0, 1e-9, 1e9})
      for (const double handMass : {0.0, 1e-6, 1e6}) {
        const std::string file = folder_.write("e.json", chainOf(mass, stiffness, handMass));
        for (const std::string& line :
             {"predict " + file + " --criterion min-hand-jerk", "predict " + file + " --criterion min-hand-force-change",
              "simulate " + file + " --hand min-jerk --until 0.1",
              "run " + file + " --device simulated --fast --trials 1 --seed 1 --data " + folder_.path()}) {
          const Ended ended = reach(line, "timeout 60");
          EXPECT_TRUE(ended.exitCode == 0 || ended.exitCode == 2 || ended.exitCode == 4)
              << line << ": " << ended.exitCode << ", mass " << mass << ", stiffness " << stiffness << ", hand " << handMass << "\n"
              << ended.err;
        }
      }
}

TEST_F(Limits, MoreNamesThanAFormulaTakesAreCountedAndNotRead) {
  std::string names;
  for (int i = 0; i < 50'000; ++i) names += (i == 0 ? "\"" : ", \"") + ("n" + std::to_string(i)) + "\": 1";
  const std::string file = folder_.write("e.json", experimentOn(R"({"name": "line", "shape": {)" + names + "}}"));
  EXPECT_TRUE(says(reach("validate " + file, "timeout 10"), 2, "constraint.shape: has 50000 names"));
}

// Each coordinate is thirty sines, one in another: what its length costs is bounded by the count of its pieces.
TEST_F(Limits, AFormulaThatBendsWithoutEndIsRefusedSoon) {
  std::string sines = "phi";
  for (int i = 0; i < 30; ++i) sines = "sin(1e3*" + sines + ")";
  const std::string curve = R"({"curve": ["phi/10 + )" + sines + R"(", ")" + sines + R"(", ")" + sines + R"("]})";
  const std::string file = folder_.write("e.json", experimentOn(curve, reachFrom("0", "1")));
  const Ended ended = reach("validate " + file, "timeout 10");
  EXPECT_TRUE(ended.exitCode == 2 || ended.exitCode == 4) << ended.exitCode << ended.err;
}

TEST_F(Limits, AForceBeyondAllThatWasTestedIsRefusedByItsOption) {
  const Ended ended = reach("simulate dingwell --hand none --until 10 --force 1e308,0,0");
  EXPECT_TRUE(says(ended, 2, "--force[0]: is 1e+308"));
  EXPECT_EQ(ended.out, "");
}

}  // namespace
