#include "gui/session/sound_cues.h"

#include <QAudioDeviceInfo>
#include <QFileInfo>
#include <QSettings>
#include <QSoundEffect>
#include <QUrl>
#include <algorithm>

#include "base/error.h"
#include "sim/experiment/resources.h"

namespace reachlab::gui::app {
namespace {

constexpr const char* kFiles[] = {"go.wav", "success.wav", "failure.wav"};

QString volumeKey() { return "sound/volume"; }

}  // namespace

SoundCues::SoundCues() {
  if (QAudioDeviceInfo::defaultOutputDevice().isNull()) return;
  try {
    const QString folder = QString::fromStdString(experiment::resourceFolder()) + "/sounds/";
    for (std::size_t i = 0; i < effects_.size(); ++i) {
      const QString file = folder + QLatin1String(kFiles[i]);
      if (!QFileInfo::exists(file)) continue;
      effects_[i] = std::make_unique<QSoundEffect>();
      effects_[i]->setSource(QUrl::fromLocalFile(file));
    }
  } catch (const Error&) {  // no resources: a silent program is better than none
  }
  setVolume(QSettings().value(volumeKey(), volume_).toDouble());
}

SoundCues::~SoundCues() = default;

void SoundCues::play(Cue cue) {
  const auto& effect = effects_[static_cast<std::size_t>(cue)];
  if (effect && !muted_) effect->play();
}

void SoundCues::setVolume(double volume) {
  volume_ = std::clamp(volume, 0.0, 1.0);
  QSettings().setValue(volumeKey(), volume_);
  const qreal amplitude = QAudio::convertVolume(volume_, QAudio::LogarithmicVolumeScale, QAudio::LinearVolumeScale);
  for (const auto& effect : effects_)
    if (effect) effect->setVolume(amplitude);
}

}  // namespace reachlab::gui::app
