#include "devices/replay/velocity_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "sim/experiment/resources.h"
#include "tests/temporary_folder.h"

namespace reachlab::devices {
namespace {

const VelocityRow& rowOf(const std::vector<VelocityRow>& rows, std::string_view kind) {
  for (const VelocityRow& row : rows)
    if (row.kind == kind) return row;
  throw std::runtime_error(std::string(kind));
}

// A minimum-jerk reach along x.
std::string writeReach(const TemporaryFolder& folder, double duration) {
  std::ostringstream table;
  table.precision(17);
  table << "time_s,x_m,y_m,z_m\n";
  for (int i = 0; i <= 300; ++i) {
    const double s = i / 300.0;
    table << duration * s << ',' << s * s * s * (10 + s * (6 * s - 15)) << ",0,0\n";
  }
  return folder.write("reach.csv", table.str());
}

// Without encoder steps only the delay is left, and that of each filter is known.
TEST(VelocityTable, DelaysAreThoseOfTheFilters) {
  // A slow minimum-jerk reach: recordings of people have frequencies beyond the cut-off, where delays are others.
  const TemporaryFolder folder;
  const auto rows = compareVelocityEstimators(writeReach(folder, 3), {.resolutions = {1e-9}});
  constexpr double kHalfTick = 0.5e-3, kFound = 0.1e-3;  // of the difference; searched in steps of 0.05 ms
  EXPECT_NEAR(rowOf(rows, "difference").delay, kHalfTick, 0.05e-3);
  EXPECT_NEAR(rowOf(rows, "butterworth").delay, kHalfTick + std::numbers::sqrt2 / (2 * std::numbers::pi * 40), kFound);
  EXPECT_NEAR(rowOf(rows, "low-pass").delay, kHalfTick + 1 / (2 * std::numbers::pi * 40), kFound);
  EXPECT_NEAR(rowOf(rows, "kalman").delay, 0, kFound);
  for (const VelocityRow& row : rows) EXPECT_LE(row.noise, row.error + 1e-15) << row.kind;
}

// One step of 0.1 mm within a tick is 0.1 m/s to the difference.
TEST(VelocityTable, EncoderStepsMakeTheDifferenceRoughAndTheFiltersSmooth) {
  const auto rows = compareVelocityEstimators(experiment::resourceFolder() + "/reaches", {.resolutions = {0.1e-3}});
  const VelocityRow& rough = rowOf(rows, "difference");
  EXPECT_GT(rough.worst, 0.05);
  for (const char* kind : {"low-pass", "butterworth", "kalman", "adaptive-window"})
    EXPECT_LT(rowOf(rows, kind).noise, 0.5 * rough.noise) << kind;
}

// A difference of a tick is the truth of half a tick ago: off by half a tick of acceleration, sqrt(120/7) d/T^2 in RMS and (10/sqrt 3) d/T^2 at
// the most of a minimum-jerk reach. The rest's and the join's 0.45 s are left out, in which little happens.
TEST(VelocityTable, TheDifferencesErrorIsHalfATickOfAcceleration) {
  constexpr double kDuration = 1.5;
  const TemporaryFolder folder;
  const auto rows = compareVelocityEstimators(writeReach(folder, kDuration), {.resolutions = {1e-12, 1e-4}});
  const double unit = 0.5e-3 * 0.2 / (kDuration * kDuration);
  EXPECT_EQ(rows.front().kind, "difference");
  EXPECT_EQ(rows.front().resolution, 1e-12);
  EXPECT_EQ(rows.back().resolution, 1e-4);
  EXPECT_EQ(rows.size() % 2, 0u);
  EXPECT_NEAR(rows.front().error, std::sqrt(120.0 / 7) * unit / std::sqrt(3.0), 0.08 * 4.14 * unit / std::sqrt(3.0)) << "an axis";
  EXPECT_NEAR(rows.front().worst, 10 / std::sqrt(3.0) * unit, 0.03 * 5.77 * unit);
  EXPECT_LT(rows.front().noise, 0.02 * rows.front().error) << "all of it is delay";
  // Steps of 0.1 mm: the difference is off by up to one of them within a tick, uniformly: sqrt(1/6) of it in RMS along x alone.
  const VelocityRow& rough = rows[rows.size() / 2];
  EXPECT_EQ(rough.kind, "difference");
  EXPECT_NEAR(rough.noise, 0.1 / std::sqrt(6.0) / std::sqrt(3.0), 0.25 * 0.1 / std::sqrt(18.0));
  EXPECT_LE(rough.worst, 0.1 + 1e-2);
  for (const VelocityRow& row : rows) {
    EXPECT_NE(row.kind, "device");
    EXPECT_NE(row.kind, "auto");
  }
  EXPECT_EQ(VelocityTableSettings{}.resolutions, (std::vector<double>{0.02e-3, 0.055e-3, 0.1e-3}));
  EXPECT_EQ(VelocityTableSettings{}.cutoff, 40);
}

}  // namespace
}  // namespace reachlab::devices
