#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/program.h"

namespace reachlab::devices {

/// How a block went: trials, and those of them that the machine's lost time has spoilt.
struct Block {
  int trials = 0, successes = 0, lostToTime = 0;
};
inline Block judge(const test::Ended& run) {
  Block block;
  for (const auto& line : test::trialLines(run.out)) {
    ++block.trials;
    if (line.at("outcome") == "success") ++block.successes;
    if (line.contains("reason") && line.at("reason") == "timing") ++block.lostToTime;
  }
  return block;
}

/// A point on a short spring: a hand that moves by a minimum-jerk law brings it there.
inline constexpr const char* kPoint =
    R"({ "schema_version": 1, "name": "point", "constraint": { "name": "line", "shape": { "length_m": 0.2 } },
  "object": { "kind": "point", "masses_kg": [0.5], "stiffness_n_per_m": [] },
  "coupling": { "stiffness_n_per_m": 900, "damping_n_s_per_m": 40 },
  "task": { "start": [0], "target": [6.283185307179586], "duration_s": 1.35,
            "tolerance": { "position_m": 0.02, "velocity_m_per_s": 0.1, "time_s": 0.8 } } })";

/// Where the computer stands still, a device that renders force is given up in words. Nothing else may end a run.
inline void expectGivenUp(const test::Ended& run) {
  EXPECT_EQ(run.exitCode, 3) << run.err;
  EXPECT_NE(run.err.find("device "), std::string::npos) << run.err;
}

/// A block of that point's reaches, recorded anew until the computer does not stand still in it. The last attempt.
inline test::Ended blockWithin(const std::string& options) {
  constexpr int kMostAttempts = 4;
  test::Ended run;
  for (int attempt = 0; attempt < kMostAttempts && run.exitCode != 0; ++attempt) {
    const TemporaryFolder folder;
    // It waits for a hand as long as it takes.
    run = test::reach("run " + folder.write("point.json", kPoint) + " " + options + " --data " + folder.path(), "timeout -s INT 60");
    if (run.exitCode == 0) break;
    expectGivenUp(run);
  }
  return run;
}

}  // namespace reachlab::devices
