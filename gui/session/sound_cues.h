#pragma once
#include <array>
#include <memory>

class QSoundEffect;

namespace reachlab::gui::app {

/// Sounds for the subject: the go signal, two rising tones after a success, a falling tone after a failure. They never wait. Without a
/// sound device they are silent.
class SoundCues {
 public:
  enum class Cue { Go, Success, Failure };
  SoundCues();
  ~SoundCues();
  void play(Cue cue);
  /// Whether there is anything to hear them with.
  void setMuted(bool muted) { muted_ = muted; }
  bool muted() const { return muted_; }
  /// 0 to 1 as perceived loudness, not as amplitude. Remembered (QSettings).
  void setVolume(double volume);
  double volume() const { return volume_; }

 private:
  std::array<std::unique_ptr<QSoundEffect>, 3> effects_;  // none without a sound device
  bool muted_ = false;
  double volume_ = 0.7;
};

}  // namespace reachlab::gui::app
