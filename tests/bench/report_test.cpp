#include <gtest/gtest.h>

#include "bench/report.h"
#include "bench/suite.h"
#include "tests/refusal.h"

namespace reachlab::bench {
namespace {

Row row(const char* scene, const char* method, double error, double price, double tolerance = 0) {
  Row r;
  r.scene = scene, r.method = method, r.error = {error, error / 10}, r.nsPerMs = price, r.tolerance = tolerance, r.step = 5e-4;
  return r;
}
std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::string line;
  for (const char c : text)
    if (c == '\n') lines.push_back(std::exchange(line, {}));
    else line += c;
  return lines;
}

TEST(Report, TheCheapestRowIsTheFirstOfTheLeastPriceThatErrsNoMoreThanAllowed) {
  const std::vector<Row> rows{row("S1", "rk4", 1e-6, 10), row("S1", "exact", 1e-12, 30), row("S1", "abm", 1e-9, 20), row("S2", "rk4", 0, 1),
                              row("S1", "stiff", 1e-9, 20)};
  const auto cheapestOf = [&](double error) {
    const Row* found = cheapest(rows, "S1", error, [](const Row&) { return true; });
    return found ? found->method : "none";
  };
  EXPECT_EQ(cheapestOf(1e-6), "rk4") << "just what is allowed";
  EXPECT_EQ(cheapestOf(0.9e-6), "abm");
  EXPECT_EQ(cheapestOf(1e-9), "abm");
  EXPECT_EQ(cheapestOf(1e-10), "exact");
  EXPECT_EQ(cheapestOf(1e-13), "none");
  EXPECT_EQ(cheapest(rows, "S1", 1, [](const Row& r) { return r.method == "exact"; })->method, "exact");
}

TEST(Report, TheTableHasAColumnForEveryNumber) {
  Row r = row("S2a", "adaptive", 2e-11, 123.45, 1e-8);
  r.nsLow = 100.25, r.nsHigh = 140.75, r.steps = 1350, r.rhsEvaluations = 2700, r.worstTick = 12, r.form = "curve in phi";
  Row failed = row("S3", "rk4", 0, 0);
  failed.failure = "capped at 0.1 s";
  const std::vector<std::string> lines = linesOf(formatTable({r, failed}));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "scene   method             setting        state  position_m ns_per_ms           quartiles   steps      rhs  worst  form");
  EXPECT_EQ(
      lines[1],
      "S2a     adaptive           tol 1e-08    2.0e-11     2.0e-12     123.5       100.2 - 140.8    1350     2700     12  curve in phi");
  EXPECT_EQ(lines[2], "S3      rk4                0.5 ms     failed: capped at 0.1 s");
}

TEST(Report, RatiosAreOfTheCheapestPeerToOursAtTwoErrors) {
  const std::vector<Row> rows{row("S2a", "auto", 1e-12, 40), row("S2a", "rk4", 1e-7, 30), row("S2a", "cvode-adams", 1e-11, 100, 1e-12),
                              row("S2a", "odeint-rk4", 5e-7, 60), row("S3", "rk4", 1e-7, 50)};
  const std::vector<std::string> lines = linesOf(formatRatios(rows));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_TRUE(holds(lines[0], "S2a     state 1e-06: ratio   1.50   ours auto (0.5 ms) 40.0"));
  EXPECT_TRUE(holds(lines[0], "peer odeint-rk4 (0.5 ms) 60.0"));
  EXPECT_TRUE(holds(lines[1], "S2a     state 1e-10: ratio   2.50   ours auto (0.5 ms) 40.0"));
  EXPECT_TRUE(holds(lines[1], "peer cvode-adams (tol 1e-12) 100.0"));
  EXPECT_TRUE(holds(lines[2], "S3      state 1e-06: ratio      -   ours rk4 (0.5 ms) 50.0"))
      << lines[2] << " where auto has no row another of ours";
  EXPECT_TRUE(holds(lines[2], "peer none"));
  EXPECT_TRUE(holds(lines[3], "S3      state 1e-10: ratio      -   ours none"));
}

std::vector<std::string> settings(const std::vector<std::string>& methods, bool quick) {
  SuiteOptions options;
  options.scenes = {"S2a"};
  options.methods = methods;
  options.quick = quick;
  options.effort = {.rounds = 1, .secondsPerRound = 0};
  std::vector<std::string> refusals, told, progress;
  for (const Row& r : runSuite(
           options, [&](const std::string& line) { progress.push_back(line); }, refusals))
    told.push_back(r.method + " " + std::to_string(r.step * 1e6) + " " + std::to_string(-std::log10(r.tolerance)));
  EXPECT_EQ(progress, std::vector<std::string>{"S2a: bead on an ellipse"});
  for (std::string& line : told)
    for (std::size_t at = line.find(".000000"); at != std::string::npos; at = line.find(".000000")) line.erase(at, 7);
  return told;
}

TEST(Suite, ScansStepsAndTolerancesAsAMethodHasThem) {
  using List = std::vector<std::string>;
  EXPECT_EQ(settings({"auto"}, false), (List{"auto 1000 inf"}));
  EXPECT_EQ(settings({"rk4"}, false), (List{"rk4 1000 inf", "rk4 500 inf", "rk4 250 inf", "rk4 100 inf"}));
  EXPECT_EQ(settings({"abm"}, false), (List{"abm 1000 inf", "abm 500 inf", "abm 250 inf"}));
  EXPECT_EQ(settings({"adaptive"}, false),
            (List{"adaptive 1000 inf", "adaptive 1000 6", "adaptive 1000 8", "adaptive 1000 10", "adaptive 1000 12"}));
  EXPECT_EQ(settings({"rk4", "adaptive"}, true), (List{"rk4 1000 inf", "adaptive 1000 inf"}));
}

TEST(Suite, RefusesUnknownNamesAndMethodsThatThisBuildDoesNotHave) {
  SuiteOptions options;
  options.effort = {.rounds = 1, .secondsPerRound = 0};
  const auto refused = [&](const char* scene, const char* method) {
    options.scenes = {scene}, options.methods = {method};
    std::vector<std::string> refusals;
    const auto nobody = [](const std::string&) {};
    return refusalOf([&] { (void)runSuite(options, nobody, refusals); });
  };
  const std::string peer = refused("S6", "odeint-rk4");  // not where the build has it
  EXPECT_TRUE(peer.empty() || holds(peer, "method odeint-rk4 is another library; configure the build with -DREACHLAB_BENCH_PEERS=ON"))
      << peer;
  const std::string euler = refused("S6", "euler");
  EXPECT_TRUE(holds(euler, "is euler"));
  EXPECT_TRUE(holds(euler, "auto, rk4, exact, abm, adaptive, stiff, odeint-rk4"));
  EXPECT_TRUE(holds(refused("S9", "auto"), "is S9"));
}

}  // namespace
}  // namespace reachlab::bench
