#include <gtest/gtest.h>

#include "tests/cli/program.h"

using namespace reachlab::test;
using Json = nlohmann::json;

TEST(Usage, HelpAndVersionEndWithZero) {
  EXPECT_EQ(reach("--version").exitCode, 0);
  for (const char* command :
       {"", "list", "validate", "run", "simulate", "predict", "analyze", "replay", "export", "recover", "constraint", "bench"}) {
    const Ended help = reach(std::string(command) + " --help");
    EXPECT_EQ(help.exitCode, 0) << command;
    EXPECT_NE(help.out.find("xample"), std::string::npos) << command << " has no example in its help";
  }
}

TEST(Usage, WrongWordsEndWithTwoAndASentence) {
  for (const char* words :
       {"", "fly", "run", "run chain-moderate", "run nothing-like-it --device simulated", "simulate chain-moderate --hand fly",
        "predict chain-moderate --criterion min-effort", "list planets", "run chain-moderate --device teleport:x --fast",
        "run chain-moderate --device simulated --fast --subject a_b", "simulate chain-moderate --hand none --until -1"}) {
    const Ended ended = reach(words);
    EXPECT_EQ(ended.exitCode, 2) << words << "\n" << ended.err;
    EXPECT_FALSE(ended.err.empty()) << words;
    EXPECT_EQ(ended.out.find("trial="), std::string::npos) << words << "\n" << ended.out;
  }
}

TEST(Usage, EveryListHasNames) {
  for (const char* what : {"experiments", "constraints", "methods", "criteria", "devices"}) {
    const Ended ended = reach(std::string("list --json ") + what);
    ASSERT_EQ(ended.exitCode, 0) << what << ended.err;
    const Json rows = Json::parse(ended.out);
    ASSERT_FALSE(rows.empty()) << what;
    for (const Json& row : rows) EXPECT_TRUE(row.at("name").is_string()) << what;
  }
}

TEST(Usage, ValidateNamesEveryFaultOfEveryFile) {
  const Folder folder;
  const std::string bad1 = folder.write("one.json", R"({"schema_version": 1, "constraint": {"name": "line"},
  "object": {"kind": "point", "masses_kg": [-1]}, "coupling": {"stiffness_n_per_m": "soft"}})");
  const std::string bad2 = folder.write("two.json", "{ \"schema_version\": 1,");
  const Ended ended = reach("validate " + bad1 + " " + bad2);
  EXPECT_EQ(ended.exitCode, 2);
  for (const char* part : {"one.json:2:", "masses_kg[0]", "coupling.stiffness_n_per_m", "two.json:1:"})
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
}

TEST(Usage, ValidateAcceptsEveryShippedFile) {
  const Ended ended = reach("validate " REACHLAB_SOURCE_DIR "/resources/experiments/*.json " REACHLAB_SOURCE_DIR
                            "/resources/plans/*.json " REACHLAB_SOURCE_DIR "/constraints/definitions/*.json");
  EXPECT_EQ(ended.exitCode, 0) << ended.err;
}

// A number that reads like a default would be recorded, or silently replaced by one.
TEST(Usage, RefusesNumbersThatAreNotFinite) {
  for (const char* arguments :
       {"run chain-moderate --device simulated --fast --trials 1 --age NaN --data not-made",
        "predict chain-moderate --criterion min-hand-jerk --duration nan",
        "predict chain-moderate --criterion min-hand-jerk --hand-mass nan", "simulate chain-moderate --hand min-jerk --until -inf"}) {
    const Ended ended = reach(arguments);
    EXPECT_EQ(ended.exitCode, 2) << arguments;
    EXPECT_FALSE(ended.err.empty()) << arguments;
  }
}
