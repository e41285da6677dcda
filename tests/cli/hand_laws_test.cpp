#include "cli/commands/hand_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "tests/cli/program.h"
#include "tests/refusal.h"

namespace reachlab::cli {
namespace {

// A point on a constraint with this task.
experiment::CompiledExperiment pointOn(const std::string& constraint, const std::string& start, const std::string& target) {
  return experiment::openExperimentText(
      R"({ "schema_version": 1, "object": { "kind": "point", "masses_kg": [1] },
    "coupling": { "stiffness_n_per_m": 100 }, "constraint": )" +
          constraint + R"(, "task": { "start": )" + start + R"(, "target": )" + target +
          R"(, "duration_s": 2, "tolerance": { "position_m": 1, "velocity_m_per_s": 1, "time_s": 1 } } })",
      "x.json");
}

HandLaw lawOf(const std::string& name, const experiment::CompiledExperiment& e) {
  return makeHandLaw(name, e.experiment(), e.constraint());
}

std::string refusalOf(const std::string& name, const experiment::CompiledExperiment& e) {
  return reachlab::refusalOf([&] { (void)lawOf(name, e); });
}

double minimumJerkAt(double s) { return s * s * s * (10 - 15 * s + 6 * s * s); }
double minimumJerkRateAt(double s) { return 30 * s * s * (1 - s) * (1 - s); }

const std::string kCircle = R"json({ "curve": ["0.1*cos(phi)", "0.1*sin(phi)", "0.02"] })json";
const std::string kLine = R"json({ "curve": ["0.1*phi", "0.3*phi", "0"] })json";

TEST(HandLaw, NoneStandsAtTheOriginAndHoldAtTheStart) {
  const auto e = pointOn(kLine, "[2]", "[3]");
  for (const double t : {0.0, 1.0, 5.0}) {
    EXPECT_EQ(lawOf("none", e).function(t).position, Vec3{});
    EXPECT_NEAR(lawOf("hold", e).function(t).position.x, 0.2, 1e-15);
    EXPECT_NEAR(lawOf("hold", e).function(t).position.y, 0.6, 1e-15);
    EXPECT_EQ(lawOf("hold", e).function(t).velocity, Vec3{});
  }
  EXPECT_TRUE(lawOf("hold", e).breaks.empty());
}

TEST(HandLaw, MinimumJerkFollowsTheChordAndStaysAtItsEnd) {
  const auto e = pointOn(kCircle, "[0]", "[\"pi/2\"]");
  const HandLaw law = lawOf("min-jerk", e);
  EXPECT_EQ(law.breaks, (std::vector<double>{0, 2}));
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const double s = minimumJerkAt(t / 2), rate = minimumJerkRateAt(t / 2) / 2;
    EXPECT_NEAR(law.function(t).position.x, 0.1 - 0.1 * s, 1e-12);
    EXPECT_NEAR(law.function(t).position.y, 0.1 * s, 1e-12);
    EXPECT_NEAR(law.function(t).position.z, 0.02, 1e-15);
    EXPECT_NEAR(law.function(t).velocity.x, -0.1 * rate, 1e-12);
    EXPECT_NEAR(law.function(t).velocity.y, 0.1 * rate, 1e-12);
  }
  EXPECT_NEAR(law.function(9).position.y, 0.1, 1e-12);
  EXPECT_EQ(norm(law.function(9).velocity), 0);
  EXPECT_NEAR(law.function(-1).position.x, 0.1, 1e-12);
}

TEST(HandLaw, AlongACircleTheAngleFollowsTheLawEitherWay) {
  for (const bool back : {false, true}) {
    const auto e = back ? pointOn(kCircle, "[1.5]", "[0.5]") : pointOn(kCircle, "[0.5]", "[1.5]");
    const HandLaw law = lawOf("min-jerk-along", e);
    EXPECT_EQ(law.breaks, (std::vector<double>{0, 2}));
    for (const double t : {0.0, 0.4, 1.0, 1.9, 2.0, 3.0}) {
      const double share = std::min(t / 2, 1.0), angle = back ? 1.5 - minimumJerkAt(share) : 0.5 + minimumJerkAt(share);
      const double speed = (back ? -1 : 1) * 0.1 * minimumJerkRateAt(share) / 2;
      EXPECT_NEAR(law.function(t).position.x, 0.1 * std::cos(angle), 1e-9);
      EXPECT_NEAR(law.function(t).position.y, 0.1 * std::sin(angle), 1e-9);
      EXPECT_NEAR(law.function(t).velocity.x, -speed * std::sin(angle), 1e-9);
      EXPECT_NEAR(law.function(t).velocity.y, speed * std::cos(angle), 1e-9);
    }
  }
}

TEST(HandLaw, FreeInSpaceAlongIsStraight) {
  const auto e = pointOn(R"({ "name": "free" })", "[0.1, 0, -0.1]", "[0.3, 0.2, 0]");
  for (const double t : {0.5, 1.0, 1.5}) {
    EXPECT_EQ(lawOf("min-jerk-along", e).function(t).position, lawOf("min-jerk", e).function(t).position);
    EXPECT_NEAR(lawOf("min-jerk", e).function(t).position.z, -0.1 + 0.1 * minimumJerkAt(t / 2), 1e-12);
  }
}

TEST(HandLaw, SaysWhatItsTaskLacks) {
  EXPECT_EQ(refusalOf("min-jerk", pointOn(kCircle, "[0]", "[\"2*pi\"]")),
            "--hand min-jerk: start and target are the same position, so there is no chord to follow; use min-jerk-along or hold");
  EXPECT_EQ(refusalOf("min-jerk-along", pointOn(kCircle, "[1]", "[1]")),
            "--hand min-jerk-along: start and target are the same position on the curve; use hold");
  EXPECT_EQ(refusalOf("min-jerk-along", experiment::openExperiment("torus")),
            "--hand min-jerk-along follows a curve; on a surface use min-jerk");
  EXPECT_EQ(refusalOf("min-jerk", experiment::openExperiment("torus")), "");
  experiment::Experiment without = experiment::readExperiment("chain-moderate");
  without.task.reset();
  for (const char* name : {"hold", "min-jerk", "min-jerk-along"})
    EXPECT_EQ(refusalOf(name, experiment::CompiledExperiment(without)),
              "--hand " + std::string(name) + " needs the experiment's task (start, target, duration_s)");
  EXPECT_EQ(refusalOf("none", experiment::CompiledExperiment(without)), "");
  EXPECT_EQ(refusalOf("fly", pointOn(kLine, "[0]", "[1]")),
            "--hand: fly cannot be read; allowed: none, hold, min-jerk, min-jerk-along, or a CSV file");
}

// A cubic spline through samples of a cubic is that cubic; before and after them the hand rests.
TEST(HandLaw, OfAFileGoesThroughItsSamplesAndRestsOutside) {
  const TemporaryFolder folder;
  const auto cubic = [](double t) { return 0.1 * t * t * t - 0.2 * t; };
  std::string table = "time_s,x_m,y_m,z_m\n";
  for (int i = 2; i <= 8; ++i) {
    const double t = 0.25 * i;
    table += std::to_string(t) + "," + std::to_string(1e6 * cubic(t)) + "e-6," + std::to_string(-t) + ",0.5\n";
  }
  const HandLaw law = lawOf(folder.write("hand.csv", table), pointOn(kLine, "[0]", "[1]"));
  ASSERT_EQ(law.breaks.size(), 7u);
  EXPECT_EQ(law.breaks.front(), 0.5);
  EXPECT_EQ(law.breaks.back(), 2);
  for (const double t : {0.5, 0.7, 1.1, 1.9}) {
    EXPECT_NEAR(law.function(t).position.x, cubic(t), 1e-9);
    EXPECT_NEAR(law.function(t).velocity.x, 0.3 * t * t - 0.2, 1e-8);
    EXPECT_NEAR(law.function(t).position.y, -t, 1e-9);
    EXPECT_NEAR(law.function(t).position.z, 0.5, 1e-12);
  }
  EXPECT_NEAR(law.sided(0.5, 0.6).velocity.y, -1, 1e-8) << "at a break by its own side";
  EXPECT_EQ(law.sided(0.5, 0.4).velocity, Vec3{});
  EXPECT_NEAR(law.sided(0.2, 0.4).position.x, cubic(0.5), 1e-9);
  EXPECT_NEAR(law.sided(3, 2.5).position.x, cubic(2), 1e-9);
  EXPECT_EQ(law.sided(2, 2.5).velocity, Vec3{});
  EXPECT_NEAR(law.sided(2, 1.9).velocity.y, -1, 1e-8);
  const dynamics::HandSegment into = law.segment(1.9, 0.1);
  EXPECT_NEAR(dynamics::sampleAt(into, 1).position.x, cubic(2), 1e-6);
  EXPECT_NEAR(dynamics::sampleAt(law.segment(2, 0.1), 0.5).position.x, cubic(2), 1e-9) << "at rest behind it";
}

}  // namespace
}  // namespace reachlab::cli
