#include "gui/subject/subject_words.h"

#include <QTranslator>

static void loadTranslations() { Q_INIT_RESOURCE(subject_translations); }

namespace reachlab::gui::subject {
const std::vector<Language>& languages() {
  static const std::vector<Language> all{{"en", "English"}, {"de", "Deutsch"}, {"ja", "日本語"}, {"ru", "Русский"}};
  return all;
}

SubjectWords::SubjectWords() = default;
SubjectWords::~SubjectWords() = default;

void SubjectWords::setLanguage(const QString& code) {
  loadTranslations();
  translator_.reset();
  language_ = "en";
  if (code == QLatin1String("en")) return;
  auto translator = std::make_unique<QTranslator>();
  if (!translator->load(QStringLiteral(":/subject/subject_%1.qm").arg(code))) return;
  translator_ = std::move(translator);
  language_ = code;
}

QString SubjectWords::say(const char* english) const {
  const QString other = translator_ ? translator_->translate("Subject", english) : QString();
  return other.isEmpty() ? QString::fromUtf8(english) : other;
}

// QT_TRANSLATE_NOOP marks the sentences for lupdate, which looks for the literals.
QString SubjectWords::instruction(const haptics::TickState& state, bool targetShown) const {
  switch (state.phase) {
    case trial::Phase::Idle: return say(QT_TRANSLATE_NOOP("Subject", "Please wait"));
    case trial::Phase::Waiting: return say(QT_TRANSLATE_NOOP("Subject", "Move to the grey sphere and rest there"));
    case trial::Phase::Armed:
      return say(!state.gone   ? QT_TRANSLATE_NOOP("Subject", "Wait for the signal")
                 : targetShown ? QT_TRANSLATE_NOOP("Subject", "Move to the yellow sphere")
                               : QT_TRANSLATE_NOOP("Subject", "Go"));
    case trial::Phase::Moving: return {};
    case trial::Phase::Done: return outcome(state.result);
  }
  return {};
}

QString SubjectWords::rest() const { return say(QT_TRANSLATE_NOOP("Subject", "Rest a little")); }
QString SubjectWords::thanks() const { return say(QT_TRANSLATE_NOOP("Subject", "That was all: thank you")); }

QString SubjectWords::outcome(const trial::TrialResult& result) const {
  if (result.outcome == trial::Outcome::Success) return say(QT_TRANSLATE_NOOP("Subject", "Well done"));
  switch (result.reason) {
    case trial::Reason::TimeShort: return say(QT_TRANSLATE_NOOP("Subject", "Too fast"));
    case trial::Reason::Position: return say(QT_TRANSLATE_NOOP("Subject", "Not at the target in time"));
    case trial::Reason::Velocity: return say(QT_TRANSLATE_NOOP("Subject", "Not at rest in time"));
    case trial::Reason::Via: return say(QT_TRANSLATE_NOOP("Subject", "Not through every ball on the way"));
    case trial::Reason::Early: return say(QT_TRANSLATE_NOOP("Subject", "Too early: wait for the signal"));
    case trial::Reason::NoOnset: return say(QT_TRANSLATE_NOOP("Subject", "No movement began"));
    default: return say(QT_TRANSLATE_NOOP("Subject", "This trial does not count"));
  }
}

}  // namespace reachlab::gui::subject
