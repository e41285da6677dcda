#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/cli/program.h"

using namespace reachlab::test;

namespace {

constexpr double kPi = std::numbers::pi;

Table simulated(const std::string& arguments) { return parseCsv(printed("simulate " + arguments)); }

}  // namespace

class Simulate : public InAFolder {};

TEST_F(Simulate, RowsFollowTheContract) {
  const Table table = simulated("chain-moderate --hand min-jerk --until 0.505 --every 0.1");
  ASSERT_EQ(table.rows.size(), 7u);  // 0, 0.1 … 0.5 and exactly 0.505
  EXPECT_EQ(table.at(6, "time_s"), 0.505);
  EXPECT_EQ(table.at(0, "mass1_x_m"), -0.1);
  EXPECT_EQ(table.header.front(), "time_s");
  EXPECT_EQ(table.header.back(), "force_z_n");
  EXPECT_EQ(table.header.size(), 1u + 3 + 5 * 8 + 3);
  EXPECT_EQ(table.header[4], "mass1_q1");
  EXPECT_EQ(table.header[5], "mass1_q1_per_s");
  EXPECT_EQ(table.header[6], "mass1_x_m");
  // phi runs from 0 to 2 pi over 0.2 m, on the line too.
  EXPECT_NEAR(table.at(6, "mass5_q1"), (table.at(6, "mass5_x_m") + 0.1) / 0.2 * 2 * kPi, 1e-12);
}

TEST_F(Simulate, ARowAtUntilIsNotWrittenTwice) {
  EXPECT_EQ(simulated("chain-moderate --hand hold --until 0.3 --every 0.1").rows.size(), 4u);
}

TEST_F(Simulate, AMethodThatIsNoneIsRefusedWithThoseThatThereAre) {
  const Ended ended = reach("simulate chain-fast --hand hold --until 0.1 --method euler");
  EXPECT_EQ(ended.exitCode, 2) << ended.out;
  for (const char* word : {"--method", "euler", "auto", "rk4", "exact", "abm", "adaptive", "stiff"})
    EXPECT_TRUE(holds(ended.err, word)) << word;
}

TEST_F(Simulate, AFallingPointFollowsTheClosedForm) {
  const std::string file = folder_.write(
      "fall.json", experimentOn(R"({"name": "free"})", "", R"("kind": "point", "masses_kg": [1], "gravity_m_per_s2": [0, -9.81, 0])"));
  const Table table = simulated(file + " --hand none --until 1 --at 0.1,0.2,0.3 --rate 1,0,0");
  const std::size_t last = table.rows.size() - 1;
  EXPECT_NEAR(table.at(last, "mass1_y_m"), 0.2 - 9.81 / 2, 1e-11);
  EXPECT_NEAR(table.at(last, "mass1_x_m"), 1.1, 1e-11);
  EXPECT_EQ(table.at(last, "force_x_n"), 0);
  EXPECT_EQ(table.at(last, "hand_x_m"), 0);
}

TEST_F(Simulate, ADampedSpringFollowsTheClosedForm) {
  const std::string file =
      folder_.write("spring.json", experimentOn(R"({"name": "line", "shape": {"length_m": 0.2}})", reachFrom("0", "6.283185307179586")));
  // The hand holds at phi = 0 (x = -0.1); the mass starts 0.1 m to its right: m x'' + 5 x' + 600 x = 0.
  const Table table = simulated(file + " --hand hold --at 3.141592653589793 --until 2 --every 0.5");
  const double decay = 2.5, omega = std::sqrt(600 - decay * decay);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double t = table.at(i, "time_s");
    const double expected = -0.1 + 0.1 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    EXPECT_NEAR(table.at(i, "mass1_x_m"), expected, 1e-12) << t;
  }
}

TEST_F(Simulate, WritesTheSameBytesUnderAGermanLocale) {
  const std::string plain = printed("simulate parallel --hand min-jerk --until 0.5");
  EXPECT_EQ(plain, printed("simulate parallel --hand min-jerk --until 0.5", "LC_ALL=de_DE.UTF-8"));
  EXPECT_FALSE(plain.empty());
}

// A cubic through not-a-knot samples is the cubic itself, so that its velocity is known everywhere, at the first and last instant too.
TEST_F(Simulate, AHandsFileHasItsInnerVelocityAtBothEndsAndRestsBeyond) {
  std::string csv = "time_s,x_m,y_m,z_m\n";
  const auto x = [](double t) { return 0.1 + 0.2 * t - 0.3 * t * t + 0.4 * t * t * t; };
  for (int i = 0; i <= 10; ++i) {
    std::ostringstream row;
    row.precision(17);
    row << 0.1 * i << ',' << x(0.1 * i) << ",0,0\n";
    csv += row.str();
  }
  const std::string hand = folder_.write("hand.csv", csv);
  const std::string file = folder_.write("free.json", experimentOn(R"({"name": "free"})"));
  const auto forces = [&](const std::string& more) {
    return simulated(file + " --hand " + hand + " --until 1.2 --every 0.1 --at 0.1,0,0" + more);
  };
  const Table table = forces("");
  // At t = 0 the mass is on the hand and at rest: the force is b v_HIP alone, 5 N s/m times 0.2 m/s.
  EXPECT_NEAR(table.at(0, "force_x_n"), 5 * 0.2, 1e-12);
  const double last = 600 * (x(1) - table.at(10, "mass1_x_m")) + 5 * (0.2 - 0.6 + 1.2 - table.at(10, "mass1_vx_m_per_s"));
  EXPECT_NEAR(table.at(10, "force_x_n"), last, 1e-11);
  EXPECT_EQ(table.at(12, "hand_x_m"), table.at(10, "hand_x_m"));
  // No tick is spoilt by an end: ten times finer steps change nothing.
  const Table fine = forces(" --step 0.0001");
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    EXPECT_NEAR(table.at(row, "mass1_x_m"), fine.at(row, "mass1_x_m"), 1e-12) << row;
}

TEST_F(Simulate, AFreeBodyTurnsAsItWasLetGo) {
  const Table table = simulated("free-body --hand none --angular-rate 0,0,0.5 --until 1 --every 1");
  EXPECT_EQ(table.at(0, "body_qw"), 1);
  EXPECT_EQ(table.at(0, "body_wz_rad_per_s"), 0.5);
  double squares = 0;
  for (const char* part : {"w", "x", "y", "z"}) squares += std::pow(table.at(1, std::string("body_q") + part), 2);
  EXPECT_NEAR(squares, 1, 1e-14);
  EXPECT_LT(table.at(1, "body_qw"), std::cos(0.2));
  EXPECT_EQ(reach("simulate chain-slow --hand none --angular-rate 0,0,1").exitCode, 2);
}

TEST_F(Simulate, ATaskWhoseWayRoundingDecidesIsToldSo) {
  const auto validated = [&](const std::string& curve, const std::string& from, const std::string& to) {
    return reach("validate " + folder_.write("e.json", experimentOn(R"({"curve": [)" + curve + "]}", reachFrom(from, to))));
  };
  const std::string ellipse = R"j("0", "0.1*cos(phi)", "0.06*sin(phi)")j";
  EXPECT_TRUE(says(validated(ellipse, "0", "3.141592653589793"), 0, "rounding decides which way"));
  EXPECT_EQ(validated(ellipse, "0.3", "3.4").err, "");
  EXPECT_TRUE(
      says(validated(R"j("phi/10", "abs(phi)/20", "0")j", "-1", "1"), 0, "between start and target: kink at phi = 0: abs(phi) (passed"));
  EXPECT_TRUE(says(validated(R"j("phi/10", "sign(phi)/20", "0")j", "-1", "1"), 2, "jump at phi = 0: sign(phi)"));
}
