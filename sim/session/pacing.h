#pragma once
#include <chrono>
#include <optional>

namespace reachlab::session {

/// The times at which the next trial and the next block may begin. They follow from the pause between two trials and the plan's rest
/// between two blocks. Both start at the end of the trial before. The caller gives the time.
class Pacing {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void pauseFor(double seconds, Time now) { nextTrial_ = after(seconds, now); }
  void restFor(double seconds, Time now) { nextBlock_ = after(seconds, now); }
  /// True once, when a pause is over.
  bool takeNextTrial(Time now) {
    if (!nextTrial_ || now < *nextTrial_) return false;
    nextTrial_.reset();
    return true;
  }
  void cancelPause() { nextTrial_.reset(); }
  /// A rest was begun and not ended, even if its time is over.
  bool rests() const { return nextBlock_.has_value(); }
  /// [s] until the next block may begin. 0: it may begin now.
  double restLeft(Time now) const { return rests() && now < *nextBlock_ ? std::chrono::duration<double>(*nextBlock_ - now).count() : 0; }

 private:
  static Time after(double seconds, Time now) {
    return now + std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(seconds));
  }
  std::optional<Time> nextTrial_, nextBlock_;
};

}  // namespace reachlab::session
