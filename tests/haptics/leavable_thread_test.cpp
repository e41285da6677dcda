#include "sim/haptics/leavable_thread.h"

#include <gtest/gtest.h>

#include <memory>
#include <semaphore>

namespace reachlab::haptics {
namespace {

using namespace std::chrono_literals;

TEST(LeavableThread, ThatWasNeverStartedHasEnded) {
  LeavableThread none;
  EXPECT_FALSE(none.running());
  EXPECT_TRUE(none.join(0ms));
  none.leave();
}

TEST(LeavableThread, IsWaitedForAsLongAsItsJobAndTheCallersPatienceLast) {
  std::binary_semaphore mayEnd{0};
  auto shared = std::make_shared<int>(7);
  LeavableThread thread([&mayEnd, shared] { mayEnd.acquire(); });
  EXPECT_TRUE(thread.running());
  EXPECT_FALSE(thread.join(1ms));
  EXPECT_TRUE(thread.running()) << "it may be asked again";
  EXPECT_EQ(shared.use_count(), 2);
  mayEnd.release();
  EXPECT_TRUE(thread.join(20s));
  EXPECT_FALSE(thread.running());
  EXPECT_TRUE(thread.join(0ms));
  EXPECT_EQ(shared.use_count(), 1) << "what its job shared is released before the end is told";
}

TEST(LeavableThread, ThatIsLeftGoesOnByItself) {
  const auto mayEnd = std::make_shared<std::binary_semaphore>(0), ended = std::make_shared<std::binary_semaphore>(0);
  {
    LeavableThread thread([mayEnd, ended] {
      mayEnd->acquire();
      ended->release();
    });
    LeavableThread moved = std::move(thread);
    EXPECT_FALSE(thread.running());
    EXPECT_TRUE(moved.running());
    EXPECT_FALSE(moved.join(1ms));
    moved.leave();
    EXPECT_FALSE(moved.running());
    EXPECT_TRUE(moved.join(0ms)) << "nobody is waited for any more";
  }
  mayEnd->release();
  EXPECT_TRUE(ended->try_acquire_for(20s));
}

}  // namespace
}  // namespace reachlab::haptics
