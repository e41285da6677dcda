#pragma once
#include <memory>

namespace reachlab::gui::app {

/// Two rising tones after a successful trial. Without a sound device it does nothing; it never waits.
class SuccessSound {
 public:
  SuccessSound();
  ~SuccessSound();
  void play();
  /// Whether there is anything to hear it with.
  bool canBeHeard() const;
  void setMuted(bool muted) { muted_ = muted; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool muted_ = false;
};

}  // namespace reachlab::gui::app
