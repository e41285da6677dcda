#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "tests/cli/program.h"

using namespace reachlab::test;

namespace {

// A free mass on each formula of tests/nasty/nasty_formulas.tsv, against 20 digits found without this program.
constexpr double kRight = 1e-9;        // [m]
constexpr double kStopsWithin = 2e-6;  // [m] of the place, where phi still tells places apart

std::vector<std::vector<std::string>> cases() {
  std::ifstream in(REACHLAB_SOURCE_DIR "/tests/nasty/nasty_formulas.tsv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) rows.push_back(split(line, '\t'));
  rows.erase(rows.begin());
  return rows;
}

}  // namespace

TEST(NastyFormulas, AreRightOrRefusedOrStoppedInWords) {
  const TemporaryFolder folder;
  const auto all = cases();
  ASSERT_GE(all.size(), 60u);
  for (const auto& c : all) {
    SCOPED_TRACE(c[0]);
    ASSERT_EQ(c.size(), 14u);
    const std::string file =
        folder.write("e.json", experimentOn(R"({")" + c[1] + R"(": [")" + c[2] + R"(", ")" + c[3] + R"(", ")" + c[4] + R"("]})", "",
                                            R"("kind": "point", "masses_kg": [1], "gravity_m_per_s2": [0, )" + c[7] + ", 0]"));
    const Ended ended =
        reach("simulate " + file + " --hand none --at=" + c[5] + " --rate=" + c[6] + " --until " + c[8] + " --every " + c[8]);
    if (c[9] == "refused") {
      EXPECT_TRUE(ended.exitCode == 2 || ended.exitCode == 4) << ended.exitCode;
      EXPECT_TRUE(holds(ended.err, c[13]));
      continue;
    }
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    const Table table = parseCsv(ended.out);
    const std::size_t last = table.rows.size() - 1;
    if (c[9] == "stopped") {
      EXPECT_EQ(ended.err.find("stopped at "), 0u) << ended.err;
      EXPECT_TRUE(holds(ended.err, c[13]));
    } else {
      EXPECT_EQ(ended.err, "");
    }
    // Whatever else happens, nothing drives a free mass but gravity.
    const auto energy = [&](std::size_t row) {
      double squares = 0;
      for (const char* axis : {"x", "y", "z"}) squares += std::pow(table.at(row, std::string("mass1_v") + axis + "_m_per_s"), 2);
      return 0.5 * squares - std::stod(c[7]) * table.at(row, "mass1_y_m");
    };
    EXPECT_NEAR(energy(last), energy(0), 1e-9 * std::abs(energy(0)) + 1e-15);
    if (c[10].empty()) continue;
    const double scale = std::max(1.0, std::abs(std::stod(c[10])));
    const double within = (c[9] == "stopped" ? kStopsWithin : kRight) * scale;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(table.at(last, std::string("mass1_") + "xyz"[k] + "_m"), std::stod(c[10 + k]), within);
  }
}
