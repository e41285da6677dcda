#include "gui/app/success_sound.h"

#include <QAudioDeviceInfo>
#include <QFileInfo>
#include <QSoundEffect>
#include <QUrl>

#include "base/error.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::app {

struct SuccessSound::Impl {
  std::unique_ptr<QSoundEffect> effect;  // none without a sound device
};

SuccessSound::SuccessSound() : impl_(std::make_unique<Impl>()) {
  if (QAudioDeviceInfo::defaultOutputDevice().isNull()) return;
  try {
    const QString file = QString::fromStdString(experiment::resourceFolder()) + QStringLiteral("/sounds/success.wav");
    if (!QFileInfo::exists(file)) return;
    impl_->effect = std::make_unique<QSoundEffect>();
    impl_->effect->setSource(QUrl::fromLocalFile(file));
    impl_->effect->setVolume(0.7);
  } catch (const Error&) {  // no resources: a silent program is better than none
  }
}

SuccessSound::~SuccessSound() = default;

void SuccessSound::play() {
  if (impl_->effect && !muted_) impl_->effect->play();
}

bool SuccessSound::canBeHeard() const { return impl_->effect != nullptr; }

}  // namespace reachlab::gui::app
