#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <thread>

#include "base/system/spsc_queue.h"
#include "base/system/triple_buffer.h"

namespace reachlab {
namespace {

// Larger than a cache line; whole only if all numbers are the same.
struct Wide {
  std::array<std::uint64_t, 64> numbers{};
};
Wide wideOf(std::uint64_t n) {
  Wide wide;
  wide.numbers.fill(n);
  return wide;
}
bool whole(const Wide& wide) {
  for (const std::uint64_t n : wide.numbers)
    if (n != wide.numbers[0]) return false;
  return true;
}

TEST(TripleBuffer, GivesTheLatestValueOnce) {
  TripleBuffer<int> buffer;
  EXPECT_EQ(buffer.takeLatest(), nullptr);
  buffer.publish(1);
  buffer.publish(2);
  const int* latest = buffer.takeLatest();
  ASSERT_NE(latest, nullptr);
  EXPECT_EQ(*latest, 2);
  EXPECT_EQ(buffer.takeLatest(), nullptr);
  buffer.publish(3);
  EXPECT_EQ(*buffer.takeLatest(), 3);
}

TEST(TripleBuffer, HandsOverWholeValuesInOrderBetweenThreads) {
  constexpr std::uint64_t kLast = 200'000;
  TripleBuffer<Wide> buffer;
  std::jthread writer([&] {
    for (std::uint64_t n = 1; n <= kLast; ++n) buffer.publish(wideOf(n));
  });
  std::uint64_t seen = 0, torn = 0, backwards = 0;
  while (seen < kLast) {
    const Wide* wide = buffer.takeLatest();
    if (wide == nullptr) continue;
    torn += !whole(*wide);
    backwards += wide->numbers[0] <= seen;
    seen = wide->numbers[0];
  }
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backwards, 0u);
}

TEST(SpscQueue, RefusesWhenFullAndKeepsTheOrder) {
  SpscQueue<int, 2> queue;
  int item = 0;
  EXPECT_FALSE(queue.tryPop(item));
  EXPECT_TRUE(queue.tryPush(1));
  EXPECT_TRUE(queue.tryPush(2));
  EXPECT_FALSE(queue.tryPush(3));
  EXPECT_TRUE(queue.tryPop(item));
  EXPECT_EQ(item, 1);
  EXPECT_TRUE(queue.tryPush(4));
  EXPECT_TRUE(queue.tryPop(item));
  EXPECT_EQ(item, 2);
  EXPECT_TRUE(queue.tryPop(item));
  EXPECT_EQ(item, 4);
}

TEST(SpscQueue, LosesAndTearsNothingBetweenThreads) {
  constexpr std::uint64_t kLast = 100'000;
  auto queue = std::make_unique<SpscQueue<Wide, 32>>();
  std::jthread writer([&] {
    for (std::uint64_t n = 1; n <= kLast; ++n) {
      const Wide wide = wideOf(n);
      while (!queue->tryPush(wide)) std::this_thread::yield();
    }
  });
  std::uint64_t wrong = 0;
  Wide wide;
  for (std::uint64_t expected = 1; expected <= kLast;) {
    if (!queue->tryPop(wide)) {
      std::this_thread::yield();
      continue;
    }
    wrong += !whole(wide) || wide.numbers[0] != expected;
    ++expected;
  }
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace reachlab
