#include "sim/session/plan.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/session/programme.h"
#include "sim/session/planned_trials.h"
#include "test_paths.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace reachlab::session {
namespace {

std::string faultsOf(const std::string& text) {
  return refusalOf([&] { parsePlan(text, "p.json"); });
}

TEST(Plan, ReadsTheKeysOfABlockAndTheDefaultsOfThePlan) {
  const Plan plan = parsePlan(R"({ "schema_version": 1, "order_seed": 9007199254740992, "pause_s": 2, "blocks": [
      { "experiment": "chain-slow", "trials": 3, "practice": true, "condition": "warm up", "day": 2 },
      { "experiment": "chain-fast", "trials": 100, "pause_s": 0.5, "foreperiod_s": [0.8, 1.6], "catch_share": 0.1,
        "repeat_aborted": true, "rest_s": 90, "instructions": "Read \"this\",\nthen begin." } ] })",
                              "p.json");
  EXPECT_EQ(plan.orderSeed, 9007199254740992ull);
  ASSERT_EQ(plan.blocks.size(), 2u);
  EXPECT_TRUE(plan.blocks[0].practice);
  EXPECT_EQ(plan.blocks[0].pauseSeconds, 2);
  EXPECT_EQ(plan.blocks[0].day, 2);
  EXPECT_EQ(plan.blocks[0].condition, "warm up");
  EXPECT_EQ(plan.blocks[1].pauseSeconds, 0.5) << "the lower level wins";
  EXPECT_EQ(plan.blocks[1].foreperiodMax, 1.6);
  EXPECT_TRUE(plan.blocks[1].repeatAborted);
  EXPECT_EQ(plan.blocks[1].restSeconds, 90);
  EXPECT_EQ(plan.blocks[1].instructions, "Read \"this\",\nthen begin.");
  EXPECT_EQ(toJson(parsePlan(toJson(plan), "p.json")), toJson(plan)) << "written and read back";
}

TEST(Plan, NamesLineColumnAndKeyOfEveryFaultAtOnce) {
  const std::string faults = faultsOf(
      "{ \"schema_version\": 1,\n  \"blocks\": [\n    { \"experiment\": \"chain-slow\", \"trails\": 3 },\n"
      "    { \"experiment\": \"chain-slow\", \"trials\": 0 },\n    { \"trials\": 1, \"pause_s\": -1 } ] }");
  EXPECT_TRUE(holds(faults, "p.json:3:"));
  EXPECT_TRUE(holds(faults, "trails"));
  EXPECT_TRUE(holds(faults, "p.json:4:"));
  EXPECT_TRUE(holds(faults, "p.json:5:"));
  EXPECT_TRUE(holds(faults, "pause_s"));
  EXPECT_TRUE(holds(faults, "experiment"));
}

TEST(Plan, RefusesWhatIsNoPlan) {
  EXPECT_NE(faultsOf("[]"), "");
  EXPECT_NE(faultsOf("{ \"schema_version\": 1, \"blocks\": [] }"), "");
  EXPECT_NE(faultsOf("{ \"schema_version\": 1, \"blocks\": {} }"), "");
  EXPECT_NE(faultsOf("{ \"schema_version\": 2, \"blocks\": [ { \"experiment\": \"chain-slow\", \"trials\": 1 } ] }"), "");
  EXPECT_NE(faultsOf("{ \"blocks\": [ { \"experiment\": \"chain-slow\", \"trials\": 1 } ] }"), "");
}

TEST(Plan, KnowsTheEdgesOfWhatItTakes) {
  const auto with = [](const std::string& settings) {
    return "{ \"schema_version\": 1, \"trials\": 2, " + settings + ", \"blocks\": [ { \"experiment\": \"chain-slow\" } ] }";
  };
  for (const char* fine : {"\"foreperiod_s\": [0, 60]", "\"foreperiod_s\": [2, 2]", "\"catch_share\": 0.5", "\"catch_share\": 0",
                           "\"order_seed\": 0", "\"pause_s\": 0", "\"counterbalance\": \"none\""})
    EXPECT_EQ(faultsOf(with(fine)), "") << fine;
  for (const char* wrong : {"\"foreperiod_s\": [0, 60.5]", "\"foreperiod_s\": [2, 1.9]", "\"foreperiod_s\": [-0.1, 1]",
                            "\"foreperiod_s\": [1]", "\"catch_share\": 0.51", "\"catch_share\": -0.1", "\"order_seed\": -1",
                            "\"order_seed\": 9007199254740994", "\"order_seed\": 0.5", "\"counterbalance\": \"latin\"", "\"day\": 1"})
    EXPECT_NE(faultsOf(with(wrong)), "") << wrong;
  const auto block = [](const std::string& settings) {
    return "{ \"schema_version\": 1, \"blocks\": [ { \"experiment\": \"chain-slow\", " + settings + " } ] }";
  };
  EXPECT_EQ(faultsOf(block("\"trials\": 1000000, \"day\": 10000")), "");
  EXPECT_NE(faultsOf(block("\"trials\": 1000001")), "");
  EXPECT_NE(faultsOf(block("\"trials\": 1, \"day\": 0")), "");
  EXPECT_TRUE(holds(faultsOf(block("\"trials\": 1, \"rest_s\": -1")), "rest_s"));
  EXPECT_NE(faultsOf(block("\"trials\": 1, \"day\": 10001")), "");
  EXPECT_EQ(parsePlan(block("\"trials\": 2"), "folder/mine.json").name, "mine");
}

TEST(BlockOrder, GivesSixSubjectsTheSixOrdersOfThreePaces) {
  const Plan plan = readPlan(std::string(REACHLAB_SOURCE_DIR) + "/resources/plans/paper.json");
  for (const int day : {1, 2}) {
    std::set<std::vector<int>> orders;
    for (const char* subject : {"01", "02", "03", "04", "05", "06"}) {
      const std::vector<int> order = blockOrder(plan, subject, day);
      orders.insert(order);
      EXPECT_EQ(order, blockOrder(plan, subject, day));
      for (const int block : order) EXPECT_EQ(plan.blocks[static_cast<std::size_t>(block)].day, day);
    }
    EXPECT_EQ(orders.size(), 6u);
  }
}

TEST(BlockOrder, LeavesPracticeBlocksWhereTheyStand) {
  const Plan plan = parsePlan(R"({ "schema_version": 1, "order_seed": 5, "counterbalance": "permute", "trials": 1, "blocks": [
      { "experiment": "chain-slow", "practice": true }, { "experiment": "chain-slow" }, { "experiment": "chain-moderate" },
      { "experiment": "chain-fast" } ] })",
                              "p.json");
  for (const char* subject : {"01", "02", "03", "anna"}) {
    const std::vector<int> order = blockOrder(plan, subject, 0);
    EXPECT_EQ(order[0], 0);
    EXPECT_EQ(std::set<int>(order.begin(), order.end()), (std::set<int>{0, 1, 2, 3}));
  }
}

TEST(BlockOrder, OfMoreThanFourConditionsIsALatinSquare) {
  std::string text = "{ \"schema_version\": 1, \"order_seed\": 2, \"counterbalance\": \"permute\", \"trials\": 1, \"blocks\": [";
  for (int i = 0; i < 5; ++i) text += std::string(i == 0 ? "" : ",") + "{ \"experiment\": \"chain-slow\" }";
  const Plan plan = parsePlan(text + "] }", "p.json");
  std::set<std::pair<int, std::size_t>> places;
  for (const char* subject : {"1", "2", "3", "4", "5"}) {
    const std::vector<int> order = blockOrder(plan, subject, 0);
    ASSERT_EQ(order.size(), 5u);
    EXPECT_EQ(std::set<int>(order.begin(), order.end()).size(), 5u);
    for (std::size_t at = 0; at < 5; ++at) places.insert({order[at], at});
  }
  EXPECT_EQ(places.size(), 25u) << "every condition once at every place";
  EXPECT_EQ(blockOrder(plan, "6", 0), blockOrder(plan, "1", 0)) << "the rows come in turn";
  EXPECT_EQ(blockOrder(plan, "anna", 0), blockOrder(plan, "anna", 0));
  std::set<std::vector<int>> named;
  for (const char* subject : {"anna", "bert", "cora", "dora", "emil", "fred", "gina", "hugo"}) named.insert(blockOrder(plan, subject, 0));
  EXPECT_GT(named.size(), 2u) << "names are spread over the rows";
  std::set<std::vector<int>> mixed, zeros;
  for (const char* subject : {"1a", "1b", "1c", "1d", "1e", "1f", "1g", "1h"}) mixed.insert(blockOrder(plan, subject, 0));
  EXPECT_GT(mixed.size(), 2u) << "what only begins with a number is a name";
  for (const char* subject : {"0", "00", "000", "0000", "00000", "000000"}) zeros.insert(blockOrder(plan, subject, 0));
  EXPECT_GT(zeros.size(), 1u) << "subjects are counted from 1";
}

// What a subject has begun with is gone on with, by a later program too. Each seed has the six orders in turns of its own.
TEST(BlockOrder, OfASeedAndSubjectIsForEver) {
  const auto orders = [](int seed) {
    const Plan plan =
        parsePlan(fmt::format(R"({{ "schema_version": 1, "order_seed": {}, "counterbalance": "permute", "trials": 1, "blocks": [
        {{ "experiment": "chain-slow" }}, {{ "experiment": "chain-moderate" }}, {{ "experiment": "chain-fast" }} ] }})",
                              seed),
                  "p.json");
    std::string all;
    for (const char* subject : {"01", "02", "03", "04", "05", "06"})
      for (const int block : blockOrder(plan, subject, 0)) all += static_cast<char>('0' + block);
    return all;
  };
  EXPECT_EQ(orders(5), "012102201210120021");
  EXPECT_EQ(orders(6), "120012102201210021");
}

TEST(BlockOrder, OfADayHasTheBlocksOfEveryDayToo) {
  const Plan plan = parsePlan(R"({ "schema_version": 1, "trials": 1, "blocks": [ { "experiment": "chain-slow", "day": 1 },
      { "experiment": "chain-slow" }, { "experiment": "chain-slow", "day": 2 } ] })",
                              "p.json");
  EXPECT_EQ(blockOrder(plan, "01", 1), (std::vector<int>{0, 1}));
  EXPECT_EQ(blockOrder(plan, "01", 2), (std::vector<int>{1, 2}));
  EXPECT_EQ(blockOrder(plan, "01", 3), (std::vector<int>{1}));
  EXPECT_EQ(blockOrder(plan, "01", 0), (std::vector<int>{0, 1, 2}));
}

TEST(PlanTrials, DrawsForeperiodsInTheirRangeFromSeedAndIndexAlone) {
  PlanBlock block;
  block.trials = 200;
  block.foreperiodMin = 0.8;
  block.foreperiodMax = 1.6;
  const std::vector<trial::PlannedTrial> many = planTrials(block, 7);
  block.trials = 50;
  const std::vector<trial::PlannedTrial> few = planTrials(block, 7);
  double sum = 0;
  for (const trial::PlannedTrial& trial : many) {
    EXPECT_GE(trial.foreperiodTicks, 800);
    EXPECT_LE(trial.foreperiodTicks, 1600);
    sum += trial.foreperiodTicks;
  }
  // Mean of 200 even draws over 800 ms: standard error 800 / sqrt(12 * 200) = 16 ms; four of them.
  EXPECT_NEAR(sum / 200, 1200, 4 * 16.4);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].foreperiodTicks, many[i].foreperiodTicks);
  EXPECT_NE(planTrials(block, 8)[3].foreperiodTicks, few[3].foreperiodTicks);
}

TEST(PlanTrials, PutsTheAskedShareOfCatchTrialsAtSeededPlacesAndNeverFirst) {
  PlanBlock block;
  block.trials = 100;
  block.catchShare = 0.1;
  std::set<std::vector<int>> placings;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<int> places;
    for (const trial::PlannedTrial& trial : planTrials(block, seed))
      if (trial.catchTrial) places.push_back(trial.index);
    EXPECT_EQ(places.size(), 10u);
    EXPECT_EQ(std::count(places.begin(), places.end(), 0), 0);
    placings.insert(places);
  }
  EXPECT_EQ(placings.size(), 20u);
}

TEST(BlockSeed, OfTheFirstBlockIsTheRunsOwn) {
  EXPECT_EQ(blockSeed(42, 1), 42u);
  EXPECT_NE(blockSeed(42, 2), 42u);
  EXPECT_NE(blockSeed(42, 2), blockSeed(42, 3));
}

TEST(Plan, IsWrittenAsAPersonWouldWriteIt) {
  const Plan plan = parsePlan(R"({ "schema_version": 1, "blocks": [ { "experiment": "chain-slow", "trials": 3 } ] })", "p.json");
  EXPECT_EQ(toJson(plan), R"({
  "schema_version": 1,
  "name": "p",
  "order_seed": 0,
  "counterbalance": "none",
  "blocks": [
    {
      "experiment": "chain-slow",
      "trials": 3
    }
  ]
}
)");
}

// Values that no file gave, as a program or an editor makes them.
TEST(Plan, HasTheSameFaultsAsAValue) {
  Plan plan = parsePlan(R"({ "schema_version": 1, "blocks": [ { "experiment": "chain-slow", "trials": 3 } ] })", "p.json");
  EXPECT_TRUE(problems(plan).empty());
  plan.blocks[0].trials = 0;
  plan.blocks[0].day = -1;
  plan.blocks[0].foreperiodMin = 2;
  plan.blocks[0].foreperiodMax = 1;
  plan.blocks[0].experiment.clear();
  EXPECT_EQ(keysTold(problems(plan)), "blocks[0].experiment blocks[0].trials blocks[0].day blocks[0].foreperiod_s");
  plan.blocks.clear();
  EXPECT_EQ(problems(plan).at(0).key, "blocks");
}

TEST(Plan, IsNoFolderOfItsName) {
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  for (const char* name : {"paper", "chain-moderate"}) {
    std::filesystem::create_directory(name);
    EXPECT_EQ(refusalOf([&] { (void)readProgramme(name); }, "read"), "read") << name;
  }
  EXPECT_TRUE(holds(refusalOf([&] { (void)readProgramme(folder.path()); }), "is a folder"));
  std::filesystem::current_path(before);
}

TEST(Plan, TellsWhatStandsForAllBlocksOnceAndThere) {
  const std::string text = R"({ "schema_version": 1, "trials": 1,
    "catch_share": 0.9, "blocks": [ { "experiment": "chain-slow" }, { "experiment": "chain-fast" } ] })";
  EXPECT_EQ(faultsOf(text), "p.json:2:20: catch_share: is 0.9; allowed: a share from 0 to 0.5");
}

TEST(Plan, ChangesTheExperimentOfABlockByTheLanguageOfStudies) {
  const std::string text = R"({ "schema_version": 1, "blocks": [
      { "experiment": "chain-slow", "trials": 1 },
      { "experiment": "chain-slow", "trials": 1, "condition": "soft", "change": { "coupling.stiffness_n_per_m": 150, "object.masses_kg[*]": 0.5 } } ] })";
  const Plan plan = parsePlan(text, "p.json");
  EXPECT_EQ(openExperimentOf(plan.blocks[0]).experiment().coupling->stiffness, 600);
  const experiment::Experiment soft = openExperimentOf(plan.blocks[1]).experiment();
  EXPECT_EQ(soft.coupling->stiffness, 150);
  EXPECT_EQ(soft.object.masses, std::vector<double>(5, 0.5));
  EXPECT_TRUE(holds(soft.text, "150")) << "a recording tells what was done";
  EXPECT_EQ(toJson(parsePlan(toJson(plan), "p.json")), toJson(plan));

  EXPECT_TRUE(holds(faultsOf(R"({ "schema_version": 1, "blocks": [ { "experiment": "chain-slow", "trials": 1, "change": { "x": 1 } } ] })"),
                    "blocks[0].condition: "));
  PlanBlock bad = plan.blocks[1];
  bad.changes = {{"coupling.stiffness_n_per_m", "-1"}};
  EXPECT_EQ(faultsToldBy([&] { openExperimentOf(bad); }).at(0).key, "change.coupling.stiffness_n_per_m");
}

}  // namespace
}  // namespace reachlab::session
