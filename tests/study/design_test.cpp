#include "analysis/study/design.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "analysis/study/chunk.h"
#include "analysis/study/points.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"
#include "tests/text_parts.h"

namespace reachlab::study {
namespace {

/// A study of the chain with more members between the braces.
Design designOf(const std::string& more, const std::string& base = R"("experiment": "chain-moderate", "subjects": 3)") {
  return parseDesign(R"({ "schema_version": 1, )" + base + more + " }", "folder/some.json");
}
std::string refusalOf(const std::string& more, const std::string& base = R"("experiment": "chain-moderate", "subjects": 3)") {
  return reachlab::refusalOf([&] { designOf(more, base); });
}

TEST(StudyDesign, TakesEveryMember) {
  const Design d = designOf(R"(, "name": "n", "description": "d", "seed": 9007199254740992, "trials": 1000000, "profiles": true,
    "chunk_trials": 7, "subject": { "kind": "plan", "noise": 0.5 }, "measures": ["by", "score"], "criteria": ["min-crackle"])");
  EXPECT_EQ(d.name, "n");
  EXPECT_EQ(d.seed, 9007199254740992u);
  EXPECT_TRUE(d.trials == 1000000 && d.profiles && d.chunkTrials == 7);
  EXPECT_EQ(d.subject, (std::vector<std::pair<std::string, std::string>>{{"kind", "plan"}, {"noise", "0.5"}}));
  EXPECT_EQ(d.measures, (std::vector<std::string>{"by", "score"}));
  EXPECT_EQ(d.criteria, std::vector<std::string>{"min-crackle"});
}

TEST(StudyDesign, RefusesWhatIsOutOfItsBounds) {
  EXPECT_EQ(refusalOf("", R"("experiment": "chain-moderate", "subjects": 100000000)"), "");
  for (const char* subjects : {"0", "100000001", "1.5"})
    expectIn(refusalOf("", R"("experiment": "chain-moderate", "subjects": )" + std::string(subjects)), {"subjects"});
  for (const char* trials : {"0", "1000001"}) expectIn(refusalOf(R"(, "trials": )" + std::string(trials)), {"trials"});
  for (const char* chunk : {"0", "1000001"}) expectIn(refusalOf(R"(, "chunk_trials": )" + std::string(chunk)), {"chunk_trials"});
  EXPECT_EQ(refusalOf(R"(, "trials": 1, "chunk_trials": 1000000)"), "");
  EXPECT_EQ(refusalOf(R"(, "chunk_trials": 1)"), "");
  expectIn(refusalOf(R"(, "seed": -1)"), {"seed"});
  expectIn(refusalOf(R"(, "seed": 9007199254740994)"), {"seed"});
  expectIn(refusalOf(R"(, "sujects": 3)"), {"sujects"});
  expectIn(refusalOf("", R"("subjects": 3)"), {"needs exactly one of experiment and plan"});
  expectIn(refusalOf("", R"("subjects": 3, "experiment": "chain-moderate", "plan": "paper")"),
           {"needs exactly one of experiment and plan"});
  expectIn(refusalOf(R"(, "trials": 3)", R"("subjects": 3, "plan": "paper")"), {"a plan says how many"});
  expectIn(refusalOf(R"(, "vary": { "plan.blocks[0].trials": [3] })"), {"is of a plan, and this study has none"});
  for (const char* names : {R"({ "from": 1, "to": 2, "step": 1 })", R"({ "uniform": [1, 2], "n": 2 })"})
    expectIn(refusalOf(R"(, "vary": { "experiment": )" + std::string(names) + "}"), {"vary.experiment: is no list"});
  expectIn(refusalOf(R"(, "vary": { "trials": [3] })", R"("subjects": 3, "plan": "paper")"), {"stands beside a plan, which has its own"});
  expectIn(refusalOf(R"(, "vary": { "experiment": ["chain-fast"] })", R"("subjects": 3, "plan": "paper")"), {"stands beside a plan"});
  expectIn(refusalOf("", R"("subjects": 3, "plan": "nowhere")"), {"is nowhere, which is not there"});
  expectIn(refusalOf(R"(, "subject": 3)"), {"is no object"});
  for (const char* option : {R"("a,b")", R"("a=b")", R"("a:b")", "true"})
    for (const char* form : {R"(, "subject": {{ "k": {} }})", R"(, "vary": {{ "subject.k": [{}] }})"})
      expectIn(refusalOf(fmt::format(fmt::runtime(form), option)), {"subject.k: is no option"});
}

// A share of the study on another computer would move along that computer's curve.
TEST(StudyDesign, KeepsTheDefinitionsOfConstraintsThatAreNotShipped) {
  const TemporaryFolder folder;
  ::setenv("REACHLAB_CONSTRAINTS", folder.path().c_str(), 1);
  const auto designWith = [&](const std::string& radius) {
    folder.write("own.json", R"j({ "schema_version": 1, "name": "own", "kind": "curve", "curve": ["a_m*cos(phi)", "a_m*sin(phi)", "0"],
      "shape": { "a_m": { "min": 0.01, "max": 1, "default": )j" +
                                 radius + R"j( } }, "domain": [0, 3], "start": [0], "target": [2] })j");
    return designOf(R"(, "vary": { "constraint.name": ["line", "own"] })");
  };
  const Design narrow = designWith("0.1"), wide = designWith("0.2");
  ::unsetenv("REACHLAB_CONSTRAINTS");
  EXPECT_EQ(narrow.definitionTexts.size(), 1u);
  EXPECT_NE(fingerprintOf(narrow), fingerprintOf(wide));
  EXPECT_EQ(taskOf(narrow, pointAt(narrow, 0)).experiments.at(0).definition, "") << "the line is shipped";
  EXPECT_EQ(taskOf(narrow, pointAt(narrow, 1)).experiments.at(0).definition, narrow.definitionTexts.at("own"));
}

TEST(StudyDesign, TakesStepsWithBothEnds) {
  const auto valuesOf = [](const std::string& steps) {
    return designOf(R"(, "vary": { "handmass_kg": )" + steps + " }").axes.at(0).values;
  };
  EXPECT_EQ(valuesOf(R"({ "from": 1, "to": 2, "step": 0.25 })"), (std::vector<std::string>{"1", "1.25", "1.5", "1.75", "2"}));
  EXPECT_EQ(valuesOf(R"({ "from": 0, "to": 0.3, "step": 0.1 })").size(), 4u) << "0.3 but for rounding";
  EXPECT_EQ(valuesOf(R"({ "from": 0, "to": 0.299, "step": 0.1 })").size(), 3u);
  EXPECT_EQ(valuesOf(R"({ "from": 5, "to": 5, "step": 1 })"), std::vector<std::string>{"5"});
  EXPECT_EQ(valuesOf(R"({ "from": -3, "to": 3, "step": 4 })"), (std::vector<std::string>{"-3", "1"}));
  EXPECT_EQ(valuesOf(R"([3, "a", true])"), (std::vector<std::string>{"3", "\"a\"", "true"}));
  for (const char* steps : {R"({ "from": 2, "to": 1, "step": 1 })", R"({ "from": 0, "to": 1000000, "step": 1 })"})
    expectIn(refusalOf(R"(, "vary": { "x": )" + std::string(steps) + "}"), {"gives no values, or more than a million"});
  expectIn(refusalOf(R"(, "vary": { "x": { "from": 0, "to": 1, "step": 0 } })"), {"vary.x.step"});
  expectIn(refusalOf(R"(, "vary": { "x": [] })"), {"vary.x: is empty"});
  expectIn(refusalOf(R"(, "vary": { "x": 3 })"), {"is no list of values"});
  expectIn(refusalOf(R"(, "vary": 3)"), {"vary: is no object"});
  for (const char* second : {"object.masses_kg[*]", "object.masses_kg", "object"})
    expectIn(refusalOf(fmt::format(R"(, "vary": {{ "object.masses_kg[0]": [1], "{}": [2] }})", second)), {"sets a value that vary."});
  EXPECT_EQ(refusalOf(R"(, "vary": { "object.masses_kg[0]": [1], "object.masses_kg[10]": [2], "object.mass": [1] })"), "");
}

TEST(StudyDesign, DrawsOneNumberOfSamplesForAllRandomAxes) {
  const Design d = designOf(R"(, "vary": { "a": { "uniform": [1, 3], "n": 4 }, "b": [1, 2, 3], "c": { "uniform": [5, 5], "n": 4 } })");
  EXPECT_EQ(d.samples, 4);
  EXPECT_EQ(d.axes[0].uniform, (std::pair<double, double>{1, 3}));
  EXPECT_FALSE(d.axes[1].uniform);
  EXPECT_EQ(pointCount(d), 12);
  EXPECT_EQ(pairCount(d), 36);
  expectIn(refusalOf(R"(, "vary": { "a": { "uniform": [1, 3], "n": 4 }, "c": { "uniform": [5, 6], "n": 5 } })"), {"is 5, and 4 before"});
  expectIn(refusalOf(R"(, "vary": { "a": { "uniform": [3, 1], "n": 4 } })"), {"is no range"});
  expectIn(refusalOf(R"(, "vary": { "a": { "uniform": [1, 3], "n": 0 } })"), {"vary.a.n"});
  expectIn(refusalOf(R"(, "vary": { "a": { "uniform": [1, 3] } })"), {"vary.a.n"});
}

TEST(StudyDesign, HasUpToAHundredMillionPoints) {
  const std::string thousands = R"({ "from": 1, "to": 10000, "step": 1 })";
  EXPECT_EQ(refusalOf(R"(, "vary": { "a": )" + thousands + R"(, "b": )" + thousands + "}"), "");
  expectIn(refusalOf(R"(, "vary": { "a": )" + thousands + R"(, "b": )" + thousands + R"(, "c": [1, 2] })"), {"makes 200000000 points"});
}

TEST(StudyPoints, RunTheLastAxisOfTheGridFastestWithTheSamplesInside) {
  const Design d = designOf(R"(, "vary": { "a": [1, 2], "u": { "uniform": [10, 20], "n": 2 }, "b": ["x", "y", "z"] })");
  EXPECT_EQ(pointCount(d), 12);
  const auto at = [&](std::int64_t i) { return pointAt(d, i); };
  EXPECT_EQ(at(0).ofAxes[0].value, "1");
  EXPECT_EQ(at(0).ofAxes[2].value, "\"x\"");
  EXPECT_EQ(at(1).ofAxes[2].value, "\"x\"") << "the second sample of the same";
  EXPECT_EQ(at(2).ofAxes[2].value, "\"y\"");
  EXPECT_EQ(at(5).ofAxes[2].value, "\"z\"");
  EXPECT_EQ(at(5).ofAxes[0].value, "1");
  EXPECT_EQ(at(6).ofAxes[0].value, "2");
  EXPECT_EQ(at(11).ofAxes[2].value, "\"z\"");
  EXPECT_EQ(at(11).index, 11);
  EXPECT_NE(at(0).ofAxes[1].value, at(1).ofAxes[1].value);
  EXPECT_EQ(at(0).ofAxes[1].value, at(10).ofAxes[1].value) << "the draws are the same at every point of the grid";
  EXPECT_EQ(describe(at(6)).substr(0, 7), "a=2, u=");
  EXPECT_TRUE(describe(at(6)).ends_with(", b=x"));
  EXPECT_EQ(describe(pointAt(designOf(""), 0)), "");
}

TEST(StudyPoints, DrawEvenlyBetweenTheEnds) {
  const Design d = designOf(R"(, "vary": { "u": { "uniform": [10, 20], "n": 2000 }, "w": { "uniform": [-1, 0], "n": 2000 } })");
  double sum = 0, squares = 0, least = 99, most = 0, cross = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point point = pointAt(d, i);
    const double u = std::stod(point.ofAxes[0].value), w = std::stod(point.ofAxes[1].value);
    EXPECT_TRUE(w >= -1 && w < 0);
    sum += u, squares += (u - 15) * (u - 15), least = std::min(least, u), most = std::max(most, u), cross += (u - 15) * (w + 0.5);
  }
  EXPECT_NEAR(sum / 2000, 15, 0.2);
  EXPECT_NEAR(squares / 2000, 100.0 / 12, 0.4);
  EXPECT_NEAR(cross / 2000, 0, 0.08) << "axes have draws of their own";
  EXPECT_TRUE(least >= 10 && least < 10.05 && most > 19.95 && most < 20);
  Design other = d;
  other.seed = 1;
  EXPECT_NE(pointAt(other, 0).ofAxes[0].value, pointAt(d, 0).ofAxes[0].value);
  other = d;
  other.name = "another";
  EXPECT_NE(pointAt(other, 0).ofAxes[0].value, pointAt(d, 0).ofAxes[0].value);
}

TEST(StudyPoints, BecomeADeviceAnExperimentAndABlock) {
  const Design d = designOf(
      R"(, "trials": 4, "subject": { "kind": "plan", "noise": 1 }, "vary": { "subject.noise": [0.5], "subject.lag": ["late"],
      "coupling.stiffness_n_per_m": [321], "experiment": ["chain-fast"], "trials": [7, 1000000] })");
  const PointTask task = taskOf(d, pointAt(d, 0));
  EXPECT_EQ(task.device, "simulated:kind=plan,noise=0.5,lag=late");
  ASSERT_EQ(task.experiments.size(), 1u);
  EXPECT_EQ(task.experiments[0].name, "chain-fast");
  EXPECT_NE(task.experiments[0].text.find("321"), std::string::npos);
  ASSERT_EQ(task.plan.blocks.size(), 1u);
  EXPECT_EQ(task.plan.blocks[0].trials, 7);
  EXPECT_EQ(task.days, std::vector<int>{0});
  EXPECT_EQ(mostTrialsOfSubject(d), 1000000);
  EXPECT_EQ(taskOf(d, pointAt(d, 1)).plan.blocks[0].trials, 1000000);
  const Design plain = designOf("");
  EXPECT_EQ(taskOf(plain, pointAt(plain, 0)).device, "simulated");
  EXPECT_EQ(taskOf(plain, pointAt(plain, 0)).experiments[0].text, plain.experimentTexts.at("chain-moderate"));
  EXPECT_EQ(mostTrialsOfSubject(plain), 1);
  for (const char* trials : {"0", "2.5", "1000001"}) {
    const Design bad = designOf(R"(, "vary": { "trials": [)" + std::string(trials) + "] }");
    expectIn(reachlab::refusalOf([&] { taskOf(bad, pointAt(bad, 0)); }),
             {"point 0 (trials=" + std::string(trials) + "): trials: is " + trials});
  }
}

TEST(StudyPoints, HaveASeedForEachPointSubjectAndDay) {
  const Design d = designOf("");
  std::vector<std::uint64_t> seeds;
  for (const auto& [point, subject, day] : {std::array{0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 1}, {1, 0, 0}, {0, 0, 1}}) {
    seeds.push_back(seedOf(d, point, subject, day));
    EXPECT_LT(seeds.back(), std::uint64_t{1} << 53);
  }
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::unique(seeds.begin(), seeds.end()), seeds.end());
  EXPECT_GT(seeds.back(), std::uint64_t{1} << 45) << "all of its bits are used";
  EXPECT_EQ(labelOfSubject(3), "03");
  EXPECT_EQ(labelOfSubject(123), "123");
}

TEST(StudyPoints, OfAPlanHaveItsBlocksAndDays) {
  const Design d = designOf("", R"("subjects": 3, "plan": "paper")");
  const PointTask task = taskOf(d, pointAt(d, 0));
  ASSERT_FALSE(task.plan.blocks.empty());
  EXPECT_EQ(task.experiments.size(), task.plan.blocks.size());
  EXPECT_GT(task.days.size(), 1u);
  EXPECT_GT(task.days.front(), 0);
  std::int64_t all = 0;
  for (const session::PlanBlock& block : task.plan.blocks)
    for (const int day : task.days) all += block.day == 0 || block.day == day ? block.trials : 0;
  EXPECT_EQ(mostTrialsOfSubject(d), all);
}

TEST(StudyPoints, OfAPlanWithVariedTrialsCountTheirOwn) {
  const Design plain = designOf("", R"("subjects": 2, "plan": "paper")");
  const Design d = designOf(R"(, "vary": { "plan.blocks[0].trials": [2, 20] })", R"("subjects": 2, "plan": "paper")");
  const std::int64_t others = mostTrialsOfSubject(plain) - taskOf(plain, pointAt(plain, 0)).plan.blocks[0].trials;
  EXPECT_EQ(mostTrialsOfSubject(d), others + 20);
  EXPECT_EQ(trialsOfPairs(d, mostTrialsOfSubject(d), 0, pairCount(d)), 2 * (others + 2) + 2 * (others + 20));
}

// 3 subjects of 12 points, 5 trials each.
TEST(StudyChunks, HoldWholeSubjectsAndAsManyTrialsAsAskedFor) {
  const std::string vary = R"(, "vary": { "a": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12] }, "trials": 5)";
  const ChunkPlan plan = planChunks(designOf(vary + R"(, "chunk_trials": 37)"));
  EXPECT_EQ(plan.pairs, 36);
  EXPECT_EQ(plan.pairsPerChunk, 7);
  EXPECT_EQ(plan.count(), 6);
  EXPECT_TRUE(plan.at(0).first == 0 && plan.at(0).end == 7 && plan.at(4).end == 35 && plan.at(5).first == 35 && plan.at(5).end == 36);
  EXPECT_EQ(planChunks(designOf(vary + R"(, "chunk_trials": 3)")).pairsPerChunk, 1) << "a subject at least";
  EXPECT_EQ(planChunks(designOf(vary)).pairsPerChunk, 400) << "2000 trials at least";
  const auto trialsPerChunk = [](std::int64_t subjects) {
    Design d;
    d.subjects = subjects;
    return planChunks(d).pairsPerChunk;
  };
  EXPECT_EQ(trialsPerChunk(1'999'999), 2000);
  EXPECT_EQ(trialsPerChunk(3'000'000), 3000) << "a thousand chunks";
  EXPECT_EQ(trialsPerChunk(100'000'000), 100'000);
  EXPECT_EQ(trialsPerChunk(101'000'000), 100'000) << "100 000 trials at most";
  const ChunkPlan exact{14, 7};
  EXPECT_EQ(exact.count(), 2);
  EXPECT_EQ(exact.at(1).end, 14);
}

}  // namespace
}  // namespace reachlab::study
