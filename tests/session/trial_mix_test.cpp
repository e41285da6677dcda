#include "sim/session/mix/mix_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/session/block_scenes.h"
#include "sim/session/programme.h"
#include "sim/session/plan.h"
#include "sim/session/planned_trials.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/text_parts.h"

// The order of kinds and targets within a block, counted trial by trial.
namespace reachlab::session {
namespace {

constexpr std::uint64_t kSeeds = 1000;

PlanBlock blockOf(const std::string& settings) {
  return parsePlan("{ \"schema_version\": 1, \"blocks\": [ { \"experiment\": \"free-point\", " + settings + " } ] }", "p.json")
      .blocks.at(0);
}

std::string faultsOfBlock(const std::string& settings) {
  return refusalOf<FaultError>([&] { blockOf(settings); });
}

const std::string kThreeKinds = R"("kinds": { "null": {}, "field": {}, "channel": {} })";
const std::string kSevenToOne = kThreeKinds + R"(, "mix": [{ "kind": "field", "count": 7 }, { "kind": "channel", "count": 1 }])";

TEST(TrialMix, EachCycleHasItsExactCountsAndEachRoundEachTargetOnceForEverySeed) {
  const PlanBlock block = blockOf(kSevenToOne + R"(, "trials": 240, "targets": { "ring": { "count": 8 } }, "order": "shuffled-cycles",
    "not_first": ["channel"], "not_twice": ["channel"])");
  std::set<std::vector<int>> different;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<MixedTrial> order = orderTrials(block.mix, block.trials, seed);
    ASSERT_EQ(order.size(), 240u);
    std::map<std::pair<int, int>, int> met;
    std::vector<int> kinds;
    for (std::size_t cycle = 0; cycle < 30; ++cycle) {
      std::array<int, 2> counts{};
      std::set<int> targets;
      for (std::size_t i = 8 * cycle; i < 8 * cycle + 8; ++i) {
        ++counts[static_cast<std::size_t>(order[i].kind)];
        targets.insert(order[i].target);
        ++met[{order[i].kind, order[i].target}];
        kinds.push_back(order[i].kind);
        EXPECT_FALSE(i > 0 && order[i].kind == 1 && order[i - 1].kind == 1) << "seed " << seed << ", trial " << i + 1;
      }
      ASSERT_EQ(counts, (std::array<int, 2>{7, 1})) << "seed " << seed;
      ASSERT_EQ(targets.size(), 8u) << "seed " << seed;
    }
    EXPECT_EQ(order[0].kind, 0);
    for (int target = 0; target < 8; ++target) EXPECT_NEAR((met[{1, target}]), 30 / 8.0, 1) << "30 channel trials over 8 targets";
    different.insert(kinds);
    if (seed < 10) {
      const std::vector<MixedTrial> again = orderTrials(block.mix, block.trials, seed);
      EXPECT_TRUE(std::equal(order.begin(), order.end(), again.begin(),
                             [](const MixedTrial& a, const MixedTrial& b) { return a.kind == b.kind && a.target == b.target; }));
    }
  }
  EXPECT_EQ(different.size(), kSeeds) << "no two seeds give the same order of 240 trials";
}

// Counts that were added without a bound wrapped round to a cycle of no trials, and every target was compared with every other.
TEST(TrialMix, OfMoreEntriesThanABlockCanHaveScenesIsRefused) {
  const auto list = [](int length, const auto& entry) {
    std::string text;
    for (int i = 0; i < length; ++i) text += (i == 0 ? "" : ",") + entry(i);
    return text;
  };
  const auto heavy = [](int) { return std::string(R"({ "kind": "field", "count": 65536 })"); };
  const auto place = [](int i) { return "[" + std::to_string(i) + ",0,0]"; };
  const auto kind = [](int i) { return "\"k" + std::to_string(i) + "\": {}"; };
  const auto name = [](int) { return std::string("\"field\""); };
  EXPECT_TRUE(holds(faultsOfBlock(kThreeKinds + R"(, "trials": 6, "mix": [)" + list(65536, heavy) + "]"), "has 65536 entries"));
  EXPECT_TRUE(holds(faultsOfBlock(R"("trials": 6, "targets": [)" + list(300'000, place) + "]"), "has 300000 entries"));
  EXPECT_TRUE(holds(faultsOfBlock(R"("trials": 6, "kinds": {)" + list(100'000, kind) + "}"), "has 100000 entries"));
  EXPECT_TRUE(holds(faultsOfBlock(kSevenToOne + R"(, "trials": 8, "not_twice": [)" + list(2001, name) + "]"), "2000 at most"));
}

// Their runs were recorded, and reach analyze could not write a file of such a name.
TEST(TrialMix, OfAConditionThatIsNoPartOfAFileNameIsRefused) {
  const auto named = [](std::size_t length) { return faultsOfBlock(R"("trials": 1, "condition": ")" + std::string(length, 'c') + "\""); };
  EXPECT_EQ(named(100), "");
  EXPECT_TRUE(holds(named(101), "condition: has 101 bytes"));
}

TEST(TrialMix, OfMoreThanAThousandBlocksIsRefusedBeforeTheyAreLookedAt) {
  const auto faultOf = [](int blocks) -> std::string {
    std::string text = R"({ "schema_version": 1, "trials": 1, "blocks": [)";
    for (int i = 0; i < blocks; ++i) text += (i == 0 ? "" : ",") + std::string(R"({ "experiment": "free-point" })");
    return refusalOf<FaultError>([&] { (void)parsePlan(text + "] }", "p.json"); });
  };
  EXPECT_EQ(faultOf(1000), "");
  EXPECT_TRUE(holds(faultOf(1001), "blocks: has 1001 blocks"));
}

// Were the cost of a draw not in proportion to the number of kinds, this would take minutes, and the test its time-out.
TEST(TrialMix, OfAThousandKindsIsOrderedInTimeInProportionToThem) {
  TrialMix mix;
  mix.order = TrialOrder::Shuffled;
  for (int k = 0; k < 1000; ++k) mix.kinds.push_back({"k" + std::to_string(k), {}}), mix.notTwice.push_back(mix.kinds.back().name);
  const std::vector<MixedTrial> order = orderTrials(mix, 100'000, 1);
  std::vector<int> often(1000);
  for (std::size_t i = 0; i < order.size(); ++i) {
    ++often[static_cast<std::size_t>(order[i].kind)];
    ASSERT_TRUE(i == 0 || order[i].kind != order[i - 1].kind) << i;
  }
  EXPECT_EQ(often, std::vector<int>(1000, 100));
}

TEST(TrialMix, ShuffledOverTheBlockHasExactCountsOfTheBlock) {
  const PlanBlock block = blockOf(kThreeKinds + R"(, "mix": [{ "kind": "null", "count": 3 }, { "kind": "field", "count": 2 },
    { "kind": "channel" }], "trials": 36, "targets": [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]], "order": "shuffled", "not_twice": ["field", "channel"])");
  bool uneven = false;  // in some cycle, else it would be the other order
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    std::array<int, 3> kinds{}, targets{};
    const std::vector<MixedTrial> order = orderTrials(block.mix, block.trials, seed);
    int firstCycle = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      ++kinds[static_cast<std::size_t>(order[i].kind)];
      ++targets[static_cast<std::size_t>(order[i].target)];
      firstCycle += i < 6 && order[i].kind == 0 ? 1 : 0;
      EXPECT_FALSE(i > 0 && order[i].kind > 0 && order[i].kind == order[i - 1].kind) << "seed " << seed;
    }
    uneven = uneven || firstCycle != 3;
    ASSERT_EQ(kinds, (std::array<int, 3>{18, 12, 6}));
    ASSERT_EQ(targets, (std::array<int, 3>{12, 12, 12}));
  }
  EXPECT_TRUE(uneven);
}

// Of three trials, one of which is b, b is as often first as second and third. 3 SD of a binomial count.
TEST(TrialMix, WithoutRulesEveryOrderOfACycleIsAsLikely) {
  const PlanBlock block = blockOf(R"("kinds": { "a": {}, "b": {} }, "mix": [{ "kind": "a", "count": 2 }, { "kind": "b" }], "trials": 3,
    "order": "shuffled-cycles")");
  std::array<int, 3> places{};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::vector<MixedTrial> order = orderTrials(block.mix, 3, seed);
    for (std::size_t i = 0; i < 3; ++i) places[i] += order[i].kind == 1 ? 1 : 0;
  }
  for (const int count : places) EXPECT_NEAR(count, kSeeds / 3.0, 3 * std::sqrt(kSeeds * 2 / 9.0));
}

// The tightest cycles that can be done: the rule leaves one order of kinds, or two.
TEST(TrialMix, FindsTheOrdersThatTightRulesLeave) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PlanBlock tight =
        blockOf(R"("kinds": { "a": {}, "b": {} }, "mix": [{ "kind": "a", "count": 3 }, { "kind": "b", "count": 2 }], "trials": 5,
      "order": "shuffled-cycles", "not_twice": ["a"])");
    std::vector<int> kinds;
    for (const MixedTrial& one : orderTrials(tight.mix, 5, seed)) kinds.push_back(one.kind);
    EXPECT_EQ(kinds, (std::vector<int>{0, 1, 0, 1, 0}));
    const PlanBlock halves = blockOf(R"("kinds": { "a": {}, "b": {} }, "trials": 20, "order": "shuffled-cycles", "not_twice": ["a", "b"],
      "not_first": ["a"])");
    const std::vector<MixedTrial> order = orderTrials(halves.mix, 20, seed);
    for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i].kind, i % 2 == 0 ? 1 : 0);
  }
}

TEST(TrialMix, AsWrittenRepeatsTheMixAndGoesThroughTheTargets) {
  const PlanBlock block = blockOf(kSevenToOne + R"(, "trials": 16, "targets": [[0.1, 0, 0], [0, 0.1, 0]])");
  const std::vector<MixedTrial> order = orderTrials(block.mix, 16, 5);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(order[i].kind, i % 8 == 7 ? 1 : 0);
    EXPECT_EQ(order[i].target, static_cast<int>(i % 2));
  }
}

TEST(TrialMix, RefusesWithKeyAndReasonWhatNoOrderCanDo) {
  const auto refused = [](const std::string& settings, const std::vector<std::string>& parts) { expectIn(faultsOfBlock(settings), parts); };
  refused(kSevenToOne + R"(, "trials": 100)", {"trials: is 100", "a cycle of the mix has 8", "96 or 104"});
  refused(R"("trials": 10, "targets": { "ring": { "count": 4 } })", {"trials: is 10", "4 targets", "8 or 12"});
  refused(kThreeKinds + R"(, "trials": 8, "mix": [{ "kind": "chanel", "count": 8 }])",
          {"mix[0].kind", "\"chanel\"", "null, field, channel"});
  refused(R"("trials": 8, "mix": [{ "kind": "a" }])", {"mix[0].kind", "has no kinds"});
  refused(kThreeKinds + R"(, "trials": 8, "mix": [{ "kind": "null", "count": 0 }])", {"mix[0].count"});
  refused(kThreeKinds + R"(, "trials": 8, "mix": [])", {"mix"});
  refused(kSevenToOne + R"(, "trials": 8, "not_first": ["null"])", {"not_first[0]", "\"null\"", "field, channel"});
  refused(kSevenToOne + R"(, "trials": 8, "order": "shuffled-cycles", "not_twice": ["field"])",
          {"not_twice", "field", "7 of 8 trials of a cycle", "at most 4"});
  refused(
      R"("kinds": { "a": {}, "b": {} }, "mix": [{ "kind": "a", "count": 3 }, { "kind": "b", "count": 2 }], "trials": 10, "order": "shuffled-cycles",
    "not_twice": ["a"])",
      {"not_twice", "3 of 5 trials of a cycle", "at most 2"});  // the next cycle may begin with a
  refused(
      R"("kinds": { "a": {}, "b": {} }, "mix": [{ "kind": "a", "count": 3 }, { "kind": "b", "count": 2 }], "trials": 5, "order": "shuffled",
    "not_twice": ["a"], "not_first": ["a"])",
      {"not_first", "no kind that the block can begin with"});
  refused(kSevenToOne + R"(, "trials": 8, "order": "shuffled", "not_first": ["field", "channel"])", {"not_first"});
  refused(kSevenToOne + R"(, "trials": 8, "not_first": ["field"])", {"not_first", "field"});
  refused(kSevenToOne + R"(, "trials": 8, "not_twice": ["field"])", {"not_twice", "trials 1 and 2"});
  refused(kSevenToOne + R"(, "trials": 8, "order": "random")", {"order", "shuffled-cycles"});
  refused(R"("kinds": { "a b": {} }, "trials": 1)", {"kinds.a b", "letters, digits"});
  refused(R"("trials": 2, "targets": [[0, 0, 0.1], [0, 0, 0.1]])", {"targets[1]", "target 1 again"});
  refused(R"("trials": 2, "targets": [[0, 0, 0.1], [0.1]])", {"targets[1]", "1 numbers"});
  refused(R"("trials": 8, "targets": { "ring": { "count": 8, "radius_m": 0 } })", {"radius_m"});
  refused(R"("trials": 8, "targets": { "rings": {} })", {"rings", "ring"});
  refused(R"("trials": 8, "return": "walk")", {"return", "reach"});
  refused(R"("trials": 8, "return": "reach", "catch_share": 0.25)", {"return", "catch"});
  refused(R"("trials": 4, "catch_share": 0.1)", {"is 0.1 of the 4 trials of a block, which is no trial", "0.125 and more"});
  refused(R"("trials": 1, "catch_share": 0.5)", {"which is no trial"});
  EXPECT_EQ(
      faultsOfBlock(kSevenToOne + R"(, "trials": 240, "targets": { "ring": { "count": 8, "radius_m": 0.1 } }, "order": "shuffled-cycles",
    "not_first": ["channel"], "not_twice": ["channel"], "return": "reach")"),
      "");
}

TEST(TrialMix, APlanWithKindsReadsBackEqual) {
  const Plan plan = parsePlan("{ \"schema_version\": 1, \"blocks\": [ { \"experiment\": \"free-point\", \"trials\": 16, " + kSevenToOne +
                                  R"(, "targets": { "ring": { "count": 8, "radius_m": 0.12, "first_deg": 90 } }, "order": "shuffled",
    "not_first": ["channel"], "not_twice": ["channel"], "return": "reach" }, { "experiment": "free-point", "trials": 2, "targets": [[0.1, 0, 0], [0, 0.1, 0]],
    "kinds": { "heavy": { "object.masses_kg[0]": 2 } } } ] })",
                              "p.json");
  const std::string text = toJson(plan);
  const Plan back = parsePlan(text, "p.json");
  EXPECT_EQ(toJson(back), text);
  EXPECT_EQ(back.blocks[0].mix.ring->radius, 0.12);
  EXPECT_EQ(back.blocks[0].mix.cycle[0].count, 7);
  EXPECT_TRUE(back.blocks[0].mix.wayBack);
  EXPECT_EQ(back.blocks[1].mix.kinds[0].changes[0].path, "object.masses_kg[0]");
  EXPECT_EQ(back.blocks[1].mix.targets[1], (std::vector<double>{0, 0.1, 0}));
}

TEST(TrialMix, KeysOfThePlanHoldForBlocksThatDoNotGiveThem) {
  const Plan plan =
      parsePlan("{ \"schema_version\": 1, \"trials\": 8, " + kThreeKinds + R"(, "targets": { "ring": { "count": 4 } }, "blocks": [
    { "experiment": "free-point", "mix": [{ "kind": "null" }] },
    { "experiment": "free-point", "mix": [{ "kind": "field", "count": 7 }, { "kind": "channel" }], "targets": [[0.1, 0, 0]] } ] })",
                "p.json");
  EXPECT_EQ(kindsInUse(plan.blocks[0].mix), std::vector<std::string>{"null"});
  EXPECT_EQ(plan.blocks[0].mix.targetCount(), 4);
  EXPECT_EQ(kindsInUse(plan.blocks[1].mix), (std::vector<std::string>{"field", "channel"}));
  EXPECT_EQ(plan.blocks[1].mix.targetCount(), 1);
}

TEST(BlockScenes, AreKindsTimesTargetsWithTheirChangesAndWaysBack) {
  const PlanBlock block = blockOf(R"("trials": 8, "return": "reach", "kinds": { "light": {}, "heavy": { "object.masses_kg[0]": 2 } },
    "targets": { "ring": { "count": 4, "radius_m": 0.1, "first_deg": 90 } })");
  const experiment::CompiledExperiment base = experiment::openExperiment("free-point");  // starts at (-0.1, 0, 0)
  const std::vector<BlockScene> scenes = scenesOf(block, base);
  ASSERT_EQ(scenes.size(), 16u);
  EXPECT_EQ(scenes[0].condition, "light 1");
  EXPECT_EQ(scenes[1].condition, "light 1-back");
  EXPECT_EQ(scenes[10].condition, "heavy 2");
  const experiment::Experiment& out = scenes[10].experiment.experiment();
  EXPECT_EQ(out.object.masses[0], 2);
  EXPECT_EQ(out.task->start, (std::vector<double>{-0.1, 0, 0}));
  EXPECT_EQ(out.task->target, (std::vector<double>{-0.2, 0, 0})) << "180 degrees: to the left";
  EXPECT_EQ(scenes[0].experiment.experiment().task->target, (std::vector<double>{-0.1, 0, -0.1})) << "90 degrees: ahead, which is -z";
  EXPECT_EQ(scenes[11].experiment.experiment().task->start, out.task->target);
  EXPECT_EQ(scenes[11].experiment.experiment().task->target, out.task->start);
  EXPECT_EQ(scenes[0].experiment.experiment().object.masses[0], 1);
  const std::vector<trial::PlannedTrial> trials = planTrials(block, 1);
  ASSERT_EQ(trials.size(), 16u);
  for (std::size_t i = 0; i < trials.size(); i += 2)
    EXPECT_EQ(trials[i + 1].scene, trials[i].scene + 1) << "the way back from the same target";
}

TEST(BlockScenes, TheWayBackPassesTheSamePlacesInTheOtherOrder) {
  const PlanBlock block =
      blockOf(R"("trials": 2, "return": "reach", "kinds": { "round": { "task.via_m": [[-0.05, 0, 0.02], [0.05, 0, 0.02]] } })");
  const std::vector<BlockScene> scenes = scenesOf(block, experiment::openExperiment("free-point"));
  ASSERT_EQ(scenes.size(), 2u);
  const std::vector<Vec3> out = scenes[0].experiment.experiment().task->via, back = scenes[1].experiment.experiment().task->via;
  EXPECT_EQ(out, (std::vector<Vec3>{{-0.05, 0, 0.02}, {0.05, 0, 0.02}}));
  EXPECT_EQ(back, (std::vector<Vec3>{out[1], out[0]}));
}

std::string scenesRefused(const std::string& experiment, const std::string& settings) {
  return refusalOf<FaultError>([&] { scenesOf(blockOf(settings), experiment::openExperiment(experiment)); });
}

TEST(BlockScenes, RefuseChangesThatTheExperimentOrTheRecordDoesNotAllow) {
  const auto refused = [](const std::string& experiment, const std::string& settings, const std::vector<std::string>& parts) {
    expectIn(scenesRefused(experiment, settings), parts);
  };
  refused("free-point", R"("trials": 1, "kinds": { "a": { "object.masses_kg[0]": -1 } })", {"kinds.a.object.masses_kg[0]", "-1"});
  refused("free-point", R"("trials": 1, "kinds": { "a": { "object.mass": 1 } })", {"kinds.a.object.mass"});
  refused("chain-fast", R"("trials": 1, "kinds": { "a": { "velocity_estimator": { "kind": "difference" } } })",
          {"kinds.a.velocity_estimator", "same value in every kind"});
  refused("free-point", R"("trials": 1, "kinds": { "a": { "force_limit_n": 3 } })", {"kinds.a.force_limit_n"});
  refused("chain-fast", R"("trials": 4, "targets": { "ring": { "count": 4 } })", {"targets.ring", "free"});
  refused("chain-fast", R"("trials": 2, "targets": [[3], [1, 2]])", {"targets[1]"});
  refused("archimedean-spiral", R"("trials": 2, "targets": [[6], [40]])", {"targets[1]"});
  refused("free-point", R"("trials": 2, "targets": [[-0.1, 0, 0], [0, 0, 0]])", {"targets[0]"});  // the start itself
  refused("free-point", R"("trials": 2, "targets": [[0, 0, 0], [0, 0, 0.1]], "kinds": { "a": { "task.target": [1, 0, 0] } })",
          {"kinds.a.task.target"});
  EXPECT_EQ(scenesRefused("chain-fast", R"("trials": 2, "targets": [[3], [6]])"), "");
}

TEST(BlockScenes, ACheckedPlanNamesTheLineOfAKindOfThePlanOrOfTheBlock) {
  const TemporaryFolder folder;
  const std::string file = folder / "p.json";
  folder.write("p.json",
               "{ \"schema_version\": 1, \"trials\": 2,\n  \"kinds\": { \"a\": {},\n    \"b\": { \"object.masses_kg\": [-1] } },\n"
               "  \"blocks\": [ { \"experiment\": \"free-point\" }, { \"experiment\": \"free-point\" },\n"
               "    { \"experiment\": \"free-point\", \"kinds\": { \"a\": {},\n      \"c\": { \"object.kind\": \"chain\" } } } ] }");
  const std::string said = refusalOf<FaultError>([&] { readProgramme(file); });
  EXPECT_TRUE(holds(said, "p.json:3:"));
  EXPECT_TRUE(holds(said, "p.json:6:"));
  EXPECT_EQ(said.find("p.json:3:"), said.rfind("p.json:3:")) << "told once for both blocks\n" << said;
}

}  // namespace
}  // namespace reachlab::session
