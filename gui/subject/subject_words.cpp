#include "gui/subject/subject_words.h"

#include <QTranslator>

static void loadTranslations() { Q_INIT_RESOURCE(subject_translations); }

namespace reachlab::gui::subject {
namespace {

// QT_TRANSLATE_NOOP marks them for lupdate, which looks for the literals.
const char* const kWait = QT_TRANSLATE_NOOP("Subject", "Please wait");
const char* const kGoToStart = QT_TRANSLATE_NOOP("Subject", "Move to the grey sphere and rest there");
const char* const kHold = QT_TRANSLATE_NOOP("Subject", "Wait for the signal");
const char* const kReach = QT_TRANSLATE_NOOP("Subject", "Move to the yellow sphere");
const char* const kGo = QT_TRANSLATE_NOOP("Subject", "Go");
const char* const kWell = QT_TRANSLATE_NOOP("Subject", "Well done");
const char* const kTooFast = QT_TRANSLATE_NOOP("Subject", "Too fast");
const char* const kNotThere = QT_TRANSLATE_NOOP("Subject", "Not at the target in time");
const char* const kNotAtRest = QT_TRANSLATE_NOOP("Subject", "Not at rest in time");
const char* const kNotPassed = QT_TRANSLATE_NOOP("Subject", "Not through every ball on the way");
const char* const kEarly = QT_TRANSLATE_NOOP("Subject", "Too early: wait for the signal");
const char* const kNoMovement = QT_TRANSLATE_NOOP("Subject", "No movement began");
const char* const kNoCount = QT_TRANSLATE_NOOP("Subject", "This trial does not count");
const char* const kRest = QT_TRANSLATE_NOOP("Subject", "Rest a little");
const char* const kThanks = QT_TRANSLATE_NOOP("Subject", "That was all: thank you");

}  // namespace

const std::vector<const char*>& subjectSentences() {
  static const std::vector<const char*> all{kWait,      kGoToStart, kHold,  kReach,      kGo,      kWell, kTooFast, kNotThere,
                                            kNotAtRest, kNotPassed, kEarly, kNoMovement, kNoCount, kRest, kThanks};
  return all;
}

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

QString SubjectWords::instruction(const haptics::TickState& state, bool targetShown) const {
  switch (state.phase) {
    case trial::Phase::Idle: return say(kWait);
    case trial::Phase::Waiting: return say(kGoToStart);
    case trial::Phase::Armed: return say(!state.gone ? kHold : targetShown ? kReach : kGo);
    case trial::Phase::Moving: return {};
    case trial::Phase::Done: return outcome(state.result);
  }
  return {};
}

QString SubjectWords::rest() const { return say(kRest); }
QString SubjectWords::thanks() const { return say(kThanks); }

QString SubjectWords::outcome(const trial::TrialResult& result) const {
  if (result.outcome == trial::Outcome::Success) return say(kWell);
  switch (result.reason) {
    case trial::Reason::TimeShort: return say(kTooFast);
    case trial::Reason::Position: return say(kNotThere);
    case trial::Reason::Velocity: return say(kNotAtRest);
    case trial::Reason::Via: return say(kNotPassed);
    case trial::Reason::Early: return say(kEarly);
    case trial::Reason::NoOnset: return say(kNoMovement);
    default: return say(kNoCount);
  }
}

}  // namespace reachlab::gui::subject
