#pragma once
#include <chrono>
#include <thread>

namespace reachlab::test {

/// Waits for an event on another thread: true once the condition holds, false when it has not come true after 20,000 looks. Nothing passes by
/// the clock: the wait ends with the event.
template <typename Condition>
bool until(Condition&& condition) {
  for (int i = 0; i < 20'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace reachlab::test
