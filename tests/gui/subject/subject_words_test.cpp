#include "gui/subject/subject_words.h"

#include <gtest/gtest.h>

#include <QRegularExpression>
#include <QSet>

namespace reachlab::gui::subject {
namespace {

TEST(SubjectWords, EverySentenceIsThereInEveryLanguageAndTellsNoNumber) {
  for (const Language& language : languages()) {
    SubjectWords words;
    words.setLanguage(language.code);
    ASSERT_EQ(words.language(), language.code) << "its translation is not in the program";
    QSet<QString> said;
    for (const char* english : subjectSentences()) {
      const QString sentence = words.say(english);
      EXPECT_FALSE(sentence.contains(QRegularExpression(QStringLiteral("[0-9]")))) << sentence.toStdString();
      const bool own = language.code == QLatin1String("en") || sentence != QString::fromUtf8(english);
      EXPECT_TRUE(own) << language.code.toStdString() << " lacks " << english;
      said.insert(sentence);
    }
    EXPECT_EQ(said.size(), static_cast<int>(subjectSentences().size())) << "two moments in the same words: " << language.code.toStdString();
  }
}

TEST(SubjectWords, TellNoOutcomeByANumber) {
  const SubjectWords words;
  haptics::TickState state;
  state.phase = trial::Phase::Done;
  for (int reason = 0; reason <= static_cast<int>(trial::kLastReason); ++reason) {
    state.result = {trial::Outcome::Failure, static_cast<trial::Reason>(reason), 3, 0.207};
    const QString sentence = words.instruction(state, true);
    EXPECT_FALSE(sentence.isEmpty());
    EXPECT_FALSE(sentence.contains(QRegularExpression(QStringLiteral("\\d")))) << sentence.toStdString();
  }
}

TEST(SubjectWords, GoIsSaidWhenTheSignalIsGivenAndNotBefore) {
  SubjectWords words;
  words.setLanguage(QStringLiteral("de"));
  haptics::TickState state;
  state.phase = trial::Phase::Armed;
  EXPECT_EQ(words.instruction(state, true), QStringLiteral("Auf das Zeichen warten"));
  state.gone = true;
  EXPECT_EQ(words.instruction(state, true), QStringLiteral("Zur gelben Kugel bewegen"));
  EXPECT_EQ(words.instruction(state, false), QStringLiteral("Los")) << "no target is shown";
}

TEST(SubjectWords, AnUnknownLanguageIsEnglish) {
  SubjectWords words;
  words.setLanguage(QStringLiteral("xx"));
  EXPECT_EQ(words.language(), QStringLiteral("en"));
  EXPECT_EQ(words.rest(), QStringLiteral("Rest a little"));
}

}  // namespace
}  // namespace reachlab::gui::subject
