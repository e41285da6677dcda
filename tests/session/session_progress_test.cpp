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

}  // namespace
}  // namespace reachlab::session
