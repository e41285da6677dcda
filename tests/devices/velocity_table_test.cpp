#include "devices/replay/velocity_table.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "sim/experiment/experiment.h"

namespace reachlab::devices {
namespace {

const VelocityRow& rowOf(const std::vector<VelocityRow>& rows, const std::string& kind) {
  for (const VelocityRow& row : rows)
    if (row.kind == kind) return row;
  throw std::runtime_error(kind);
}

// Without encoder steps only the delay is left, and that of each filter is known.
TEST(VelocityTable, DelaysAreThoseOfTheFilters) {
  VelocityTableSettings settings;
  settings.resolutions = {1e-9};
  // A slow minimum-jerk reach: recordings of people have frequencies beyond the cut-off, where delays are others.
  const std::string file = (std::filesystem::temp_directory_path() / ("reach-" + std::to_string(::getpid()) + ".csv")).string();
  {
    std::ofstream out(file);
    out << "time_s,x_m,y_m,z_m\n";
    for (int i = 0; i <= 300; ++i) {
      const double s = i / 300.0;
      out << 0.01 * i << ',' << 0.2 * s * s * s * (10 + s * (6 * s - 15)) << ",0,0\n";
    }
  }
  const auto rows = compareVelocityEstimators(file, settings);
  std::filesystem::remove(file);
  constexpr double kHalfTick = 0.5e-3, kFound = 0.1e-3;  // of the difference; searched in steps of 0.05 ms
  EXPECT_NEAR(rowOf(rows, "difference").delay, kHalfTick, 0.05e-3);
  EXPECT_NEAR(rowOf(rows, "butterworth").delay, kHalfTick + std::numbers::sqrt2 / (2 * std::numbers::pi * 40), kFound);
  EXPECT_NEAR(rowOf(rows, "low-pass").delay, kHalfTick + 1 / (2 * std::numbers::pi * 40), kFound);
  EXPECT_NEAR(rowOf(rows, "kalman").delay, 0, kFound);
  for (const VelocityRow& row : rows) EXPECT_LE(row.noise, row.error + 1e-15) << row.kind;
}

// One step of 0.1 mm within a tick is 0.1 m/s to the difference.
TEST(VelocityTable, EncoderStepsMakeTheDifferenceRoughAndTheFiltersSmooth) {
  VelocityTableSettings settings;
  settings.resolutions = {0.1e-3};
  const auto rows = compareVelocityEstimators(experiment::resourceFolder() + "/reaches", settings);
  const VelocityRow& rough = rowOf(rows, "difference");
  EXPECT_GT(rough.worst, 0.05);
  for (const char* kind : {"low-pass", "butterworth", "kalman", "adaptive-window"})
    EXPECT_LT(rowOf(rows, kind).noise, 0.5 * rough.noise) << kind;
}

}  // namespace
}  // namespace reachlab::devices
