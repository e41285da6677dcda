#include <gtest/gtest.h>

#include "tests/cli/program.h"

using namespace reachlab::test;

// The criterion of this hand is known. Where its mass was not among the tried ones, another criterion was named.
TEST(HandMass, AHeavyHandIsNotTakenForAnotherCriterion) {
  for (const char* mass : {"3", "4"}) {
    const TemporaryFolder folder;
    const std::string data = (folder / "data").string();
    ASSERT_EQ(reach("run dingwell --device simulated:criterion=min-hand-force,hand-mass=" + std::string(mass) +
                    " --trials 60 --seed 7 --fast --data " + data)
                  .exitCode,
              0);
    const std::string all = reach("analyze " + data).out;
    const std::string conclusion = all.substr(0, all.find('\n'));
    EXPECT_NE(conclusion.find("follow (4) min-hand-force"), std::string::npos) << mass << " kg: " << conclusion;
  }
}
