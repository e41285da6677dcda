#include "sim/session/session_progress.h"

#include <gtest/gtest.h>

#include "sim/session/programme.h"

namespace reachlab::session {
namespace {

TEST(Standing, OfASessionThatIsNotBegunHasTheSubjectsOwnOrder) {
  SessionRequest request;
  request.what = "paper";
  request.place = {"/nonexistent/data", "02", "01"};
  const Programme programme = readProgramme("paper");
  const SessionProgress progress = progressOf(request, programme);
  ASSERT_EQ(progress.blocks.size(), 3u) << "of day 1";
  const std::vector<int> order = blockOrder(programme.plan, "02", 1);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(progress.blocks[k].block, static_cast<int>(k) + 1);
    EXPECT_EQ(progress.blocks[k].condition, programme.plan.blocks[static_cast<std::size_t>(order[k])].condition);
    EXPECT_EQ(progress.blocks[k].trials, 100);
    EXPECT_EQ(progress.blocks[k].done, 0);
  }
  EXPECT_FALSE(progress.begun());
  EXPECT_FALSE(progress.complete());
}

TEST(Plan, WithRestAndInstructionsReadsBackEqual) {
  Plan plan;
  plan.name = "mine";
  plan.orderSeed = 12;
  plan.counterbalance = Counterbalance::Permute;
  plan.blocks.push_back({.experiment = "chain-slow",
                         .changes = {},
                         .trials = 3,
                         .practice = true,
                         .pauseSeconds = 1.5,
                         .condition = "slow",
                         .day = 2,
                         .foreperiodMin = 0.5,
                         .foreperiodMax = 1,
                         .catchShare = 0.1,
                         .repeatAborted = true,
                         .restSeconds = 90,
                         .instructions = "Read \"this\",\nthen begin.",
                         .mix = {}});
  const Plan read = parsePlan(toJson(plan), "mine.json");
  EXPECT_EQ(toJson(read), toJson(plan));
  EXPECT_EQ(read.blocks[0].instructions, plan.blocks[0].instructions);
  EXPECT_EQ(read.blocks[0].restSeconds, 90);
  EXPECT_EQ(read.blocks[0].day, 2);
  plan.blocks[0].restSeconds = -1;
  ASSERT_EQ(problems(plan).size(), 1u);
  EXPECT_EQ(problems(plan)[0].key, "blocks[0].rest_s");
}

}  // namespace
}  // namespace reachlab::session
