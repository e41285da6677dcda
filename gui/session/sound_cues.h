#pragma once
#include <memory>

namespace reachlab::gui::app {

/// What the subject hears: the go signal, two rising tones after a success, a falling one after a failure. Without a sound device they do
/// nothing; they never wait.
class SoundCues {
 public:
  enum class Cue { Go, Success, Failure };
  SoundCues();
  ~SoundCues();
  void play(Cue cue);
  /// Whether there is anything to hear them with.
  void setMuted(bool muted) { muted_ = muted; }
  /// 0 to 1, as it is heard (not as amplitude); remembered (QSettings).
  void setVolume(double volume);
  double volume() const { return volume_; }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
  bool muted_ = false;
  double volume_ = 0.7;
};

}  // namespace reachlab::gui::app
