#include <gtest/gtest.h>

#include <set>

#include "bench/sampled_hand.h"
#include "bench/suite.h"

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
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
  EXPECT_TRUE(has(lines[0], "S2a     state 1e-06: ratio   1.50   ours auto (0.5 ms) 40.0")) << lines[0];
  EXPECT_TRUE(has(lines[0], "peer odeint-rk4 (0.5 ms) 60.0")) << lines[0];
  EXPECT_TRUE(has(lines[1], "S2a     state 1e-10: ratio   2.50   ours auto (0.5 ms) 40.0")) << lines[1];
  EXPECT_TRUE(has(lines[1], "peer cvode-adams (tol 1e-12) 100.0")) << lines[1];
  EXPECT_TRUE(has(lines[2], "S3      state 1e-06: ratio      -   ours rk4 (0.5 ms) 50.0"))
      << lines[2] << " where auto has no row another of ours";
  EXPECT_TRUE(has(lines[2], "peer none"));
  EXPECT_TRUE(has(lines[3], "S3      state 1e-10: ratio      -   ours none")) << lines[3];
}

TEST(Report, OtherLibrariesAreKnownByTheirNames) {
  for (const char* name : {"odeint-rk4", "odeint-dopri5", "odeint-fehlberg78", "cvode-adams", "cvode-bdf"})
    EXPECT_TRUE(isPeer(row("S1", name, 0, 0))) << name;
  for (const std::string& name : methodNames()) EXPECT_FALSE(isPeer(row("S1", name.c_str(), 0, 0))) << name;
  EXPECT_EQ(methodNames(), (std::vector<std::string>{"auto", "rk4", "exact", "abm", "adaptive", "stiff"}));
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}
/// [mm] of an SVG.
double sizeOf(const std::string& svg, const std::string& side) { return std::stod(svg.substr(svg.find(side + "=\"") + side.size() + 2)); }

TEST(Report, TheFigureHasFourPanelsInARow) {
  std::vector<Row> rows;
  std::vector<double> width, height;
  for (const char* scene : {"S1", "S2a", "S3", "S4", "S5"}) {
    rows.push_back(row(scene, "auto", 1e-12, 40));
    const std::string svg = drawWorkPrecision(rows);
    width.push_back(sizeOf(svg, "width")), height.push_back(sizeOf(svg, "height"));
  }
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_GT(width[i] - width[i - 1], 50) << "a panel more in the row";
    EXPECT_EQ(height[i], height[0]);
  }
  EXPECT_EQ(width[4], width[3]);
  EXPECT_GT(height[4] - height[3], 40) << "the fifth begins another";
  EXPECT_GT(width[3] / height[3], 3);
}

TEST(Report, TheFigureNamesItsScenesAndMethodsOnce) {
  const std::vector<Row> one{row("S1", "rk4", 1e-7, 30)};
  const auto drawn = [](const char* scene, const char* method) {
    return drawWorkPrecision({row("S1", "rk4", 1e-7, 30), row(scene, method, 1e-7, 30)});
  };
  EXPECT_NE(drawn("S2a", "rk4"), drawn("S3", "rk4")) << "a panel's title";
  EXPECT_NE(drawn("S1", "abm"), drawn("S1", "stiff")) << "the legend";
  EXPECT_NE(drawWorkPrecision(one), drawn("S1", "abm"));
}

// What is dearer and no better than another setting of the same method is not drawn, nor what failed or is no motion.
TEST(Report, OnlyWhatIsWorthItsPriceIsDrawn) {
  const std::vector<Row> good{row("S1", "rk4", 1e-7, 30), row("S1", "rk4", 1e-9, 60)};
  const auto with = [&](Row more) {
    std::vector<Row> rows = good;
    rows.push_back(std::move(more));
    return drawWorkPrecision(rows);
  };
  const std::string svg = drawWorkPrecision(good);
  EXPECT_EQ(with(row("S1", "rk4", 1e-7, 90)), svg) << "dearer, and worse than the second";
  EXPECT_EQ(with(row("S1", "rk4", 1e-7, 45)), svg) << "dearer than the first, and as good";
  EXPECT_EQ(with(row("S1", "rk4", 1, 10)), svg) << "an error of a metre";
  EXPECT_NE(with(row("S1", "rk4", 0.9, 10)), svg);
  EXPECT_NE(with(row("S1", "rk4", 1e-8, 45)), svg);
  Row failed = row("S1", "rk4", 1e-12, 10);
  failed.failure = "capped";
  EXPECT_EQ(with(failed), svg);
  EXPECT_EQ(drawWorkPrecision({good[1], good[0]}), svg) << "in the order of the prices";
  EXPECT_EQ(with(row("S1", "rk4", 0, 90)), with(row("S1", "rk4", 1e-16, 90))) << "exact to rounding stands at the bottom";
  EXPECT_NE(with(row("S1", "rk4", 2e-16, 90)), with(row("S1", "rk4", 1e-16, 90)));
}

// Auto lies on the method that it chose: it is drawn last and larger, in a colour that no panel changes; other libraries are dashed.
TEST(Report, AutoIsDrawnOverTheOthersAndPeersAreDashed) {
  const std::string first = drawWorkPrecision({row("S1", "auto", 1e-12, 40), row("S1", "rk4", 1e-7, 30)}),
                    last = drawWorkPrecision({row("S1", "rk4", 1e-7, 30), row("S1", "auto", 1e-12, 40)});
  EXPECT_EQ(first, last);
  const std::vector<Row> two{row("S1", "rk4", 1e-7, 30), row("S1", "rk4", 1e-9, 60)};
  std::vector<Row> peers = two;
  for (Row& r : peers) r.method = "odeint-rk4";
  EXPECT_EQ(count(drawWorkPrecision(two), "dasharray"), 0);
  EXPECT_GT(count(drawWorkPrecision(peers), "dasharray"), 0);
  // Another name alone changes the legend of the first panel, and nothing behind it.
  const auto drawn = [](const char* method) { return drawWorkPrecision({row("S1", method, 1e-7, 30), row("S2a", method, 1e-9, 60)}); };
  const auto sameFromTheEnd = [](const std::string& x, const std::string& y) {
    return std::mismatch(x.rbegin(), x.rend(), y.rbegin(), y.rend()).first - x.rbegin();
  };
  EXPECT_LT(sameFromTheEnd(drawn("auto"), drawn("rk4")), sameFromTheEnd(drawn("abm"), drawn("rk4"))) << "its markers are larger";
}

TEST(Report, SampledHandsAreToldByTheirPath) {
  const std::vector<std::string> lines = linesOf(formatSampledHand({{"S1", "auto", 1, 2e-4, 3e-4, 4e-5},
                                                                    {"S1", "auto", 2, 2e-4, 3e-4, 4e-5},
                                                                    {"S1", "auto", 3, 2e-4, 3e-4, 4e-5},
                                                                    {"S2a", "rk4", 4, 1.5e-9, 2.2e-5, 3e-5}}));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "scene  method    path           clean  noise 10 um  quantised 60 um   position error, m");
  EXPECT_EQ(lines[1], "S1     auto      held         2.0e-04      3.0e-04          4.0e-05");
  EXPECT_EQ(lines[4], "S2a    rk4       cubic        1.5e-09      2.2e-05          3.0e-05");
  EXPECT_TRUE(has(lines[2], " line ") && has(lines[3], " parabola "));
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

TEST(Suite, AMethodOfAnotherLibraryIsForBuildsThatHaveIt) {
  SuiteOptions options;
  options.scenes = {"S6"};
  options.methods = {"odeint-rk4"};
  options.effort = {.rounds = 1, .secondsPerRound = 0};
  std::vector<std::string> refusals;
  try {
    (void)runSuite(
        options, [](const std::string&) {}, refusals);
  } catch (const std::exception& refusal) {
    EXPECT_TRUE(has(refusal.what(), "method odeint-rk4 is another library; configure the build with -DREACHLAB_BENCH_PEERS=ON"))
        << refusal.what();
  }
  options.methods = {"euler"};
  try {
    (void)runSuite(
        options, [](const std::string&) {}, refusals);
    FAIL();
  } catch (const std::exception& refusal) {
    EXPECT_TRUE(has(refusal.what(), "is euler")) << refusal.what();
    EXPECT_TRUE(has(refusal.what(), "auto, rk4, exact, abm, adaptive, stiff, odeint-rk4")) << refusal.what();
  }
}

}  // namespace
}  // namespace reachlab::bench
