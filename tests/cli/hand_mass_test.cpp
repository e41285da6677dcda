#include <gtest/gtest.h>

#include "tests/cli/program.h"

using namespace reachlab::test;

// The criterion of this hand is known. Where its mass was not among the tried ones, another criterion was named.
TEST(HandMass, AHeavyHandIsNotTakenForAnotherCriterion) {
  for (const char* mass : {"3", "4"}) {
    const TemporaryFolder folder;
    const std::string data = (folder / "data").string();
    printed("run dingwell --device simulated:criterion=min-hand-force,hand-mass=" + std::string(mass) +
            " --trials 60 --seed 7 --fast --data " + data);
    const std::string all = printed("analyze " + data);
    EXPECT_TRUE(holds(all.substr(0, all.find('\n')), "follow (4) min-hand-force")) << mass << " kg";
  }
}
