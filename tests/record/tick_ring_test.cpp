#include "sim/record/log/tick_ring.h"

#include <gtest/gtest.h>

namespace reachlab::record {
namespace {

// Pushes tick `number`, with a row of its own when asked for; false where there is no room.
bool push(TickRing& ring, std::uint64_t number, bool wantsRow, std::size_t columns) {
  double* space = nullptr;
  QueuedTick* slot = ring.beginPush(space);
  if (slot == nullptr) return false;
  slot->stamp.tick = number;
  slot->hasRow = wantsRow && space != nullptr;
  if (slot->hasRow)
    for (std::size_t k = 0; k < columns; ++k) space[k] = static_cast<double>(10 * number + k);
  for (std::size_t k = 0; k < ring.deviceSpace(slot).size(); ++k)
    ring.deviceSpace(slot)[k].buttons = static_cast<std::uint32_t>(100 * number + k);
  ring.publish(slot->hasRow);
  return true;
}

// Takes the oldest, which is tick `number`.
void expectPop(TickRing& ring, std::uint64_t number, bool hasRow, std::size_t columns, std::size_t hands) {
  SCOPED_TRACE(number);
  const double* row = nullptr;
  const QueuedTick* tick = ring.front(row);
  ASSERT_NE(tick, nullptr);
  EXPECT_EQ(tick->stamp.tick, number);
  ASSERT_EQ(row != nullptr, hasRow);
  for (std::size_t k = 0; hasRow && k < columns; ++k) EXPECT_EQ(row[k], static_cast<double>(10 * number + k));
  ASSERT_EQ(ring.devicesOf(tick).size(), hands);
  for (std::size_t k = 0; k < hands; ++k) EXPECT_EQ(ring.devicesOf(tick)[k].buttons, 100 * number + k);
  ring.pop(hasRow);
}

TEST(TickRing, HoldsAsManyTicksAsItWasMadeForInTheirOrder) {
  TickRing ring(3, 3, 2, 2);
  const double* row = nullptr;
  EXPECT_EQ(ring.front(row), nullptr) << "empty";
  for (std::uint64_t round = 0; round < 5; ++round) {
    const std::uint64_t first = 1 + 3 * round;
    for (std::uint64_t k = 0; k < 3; ++k) EXPECT_TRUE(push(ring, first + k, true, 2));
    EXPECT_FALSE(push(ring, 99, true, 2)) << "full";
    for (std::uint64_t k = 0; k < 3; ++k) expectPop(ring, first + k, true, 2, 2);
    EXPECT_EQ(ring.front(row), nullptr);
  }
}

TEST(TickRing, RowsHaveAStoreOfTheirOwn) {
  TickRing ring(7, 2, 3, 0);
  std::uint64_t pushed = 0, popped = 0;
  for (int round = 0; round < 40; ++round) {
    for (int k = 0; k < 2; ++k, ++pushed) ASSERT_TRUE(push(ring, pushed, pushed % 3 == 0, 3));
    for (; popped + 3 < pushed; ++popped) expectPop(ring, popped, popped % 3 == 0, 3, 0);
  }
}

TEST(TickRing, ATickForWhoseRowThereIsNoRoomGoesWithoutIt) {
  TickRing ring(4, 2, 1, 0);
  for (std::uint64_t k = 1; k <= 4; ++k) EXPECT_TRUE(push(ring, k, true, 1));
  for (std::uint64_t k = 1; k <= 4; ++k) expectPop(ring, k, k <= 2, 1, 0);
  EXPECT_TRUE(push(ring, 5, true, 1));
  expectPop(ring, 5, true, 1, 0);
}

}  // namespace
}  // namespace reachlab::record
