#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <semaphore>
#include <thread>

namespace reachlab::haptics {

/// A thread that may hang in a device's call and can then be left behind. The job must own or share everything that it uses. A thread that
/// is left runs for as long as it hangs, and ends with the program.
class LeavableThread {
 public:
  LeavableThread() = default;
  explicit LeavableThread(std::function<void()> job) : ended_(std::make_shared<std::binary_semaphore>(0)) {
    thread_ = std::thread([ended = ended_, job = std::move(job)]() mutable {
      job();
      job = nullptr;  // what it shares is released before the end is told
      ended->release();
    });
  }
  LeavableThread(LeavableThread&&) = default;
  LeavableThread& operator=(LeavableThread&&) = default;
  ~LeavableThread() { leave(); }

  bool running() const { return thread_.joinable(); }
  /// True if the job has ended by then. The thread is then joined. May be asked again.
  bool joinUntil(std::chrono::steady_clock::time_point then) {
    if (!thread_.joinable()) return true;
    if (!ended_->try_acquire_until(then)) return false;
    thread_.join();
    return true;
  }
  bool join(std::chrono::milliseconds patience) { return joinUntil(std::chrono::steady_clock::now() + patience); }
  void leave() {
    if (thread_.joinable()) thread_.detach();
  }

 private:
  std::shared_ptr<std::binary_semaphore> ended_;
  std::thread thread_;
};

}  // namespace reachlab::haptics
