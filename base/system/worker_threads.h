#pragma once
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace reachlab {

/// Runs `work(ended)` on each of several threads. The caller's thread is one of them, and returns when all threads have ended. The first
/// exception sets `ended`, so that the other threads stop, and is thrown here.
template <class Work>
void runOnThreads(unsigned threads, Work&& work) {
  std::atomic<bool> ended{false};
  std::mutex mutex;
  std::exception_ptr fault;
  const auto guarded = [&] {
    try {
      work(std::as_const(ended));
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!fault) fault = std::current_exception();
      ended = true;
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(guarded);
    guarded();
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace reachlab
