#include "gui/subject/subject_words.h"

#include <gtest/gtest.h>

#include <QRegularExpression>
#include <QStringList>

namespace reachlab::gui::subject {
namespace {

// Every sentence of every moment, in the same order for every language.
QStringList everySentence(const QString& language) {
  SubjectWords words;
  words.setLanguage(language);
  EXPECT_EQ(words.language(), language) << "its translation is not in the program";
  haptics::TickState state;
  QStringList all{words.rest(), words.thanks(), words.outcome({trial::Outcome::Success})};
  for (const auto phase : {trial::Phase::Idle, trial::Phase::Waiting, trial::Phase::Armed}) {
    state.phase = phase;
    all << words.instruction(state, true);
  }
  state.gone = true;
  all << words.instruction(state, true) << words.instruction(state, false);
  state.phase = trial::Phase::Done;
  for (int reason = 0; reason <= static_cast<int>(trial::kLastReason); ++reason) {
    state.result = {trial::Outcome::Failure, static_cast<trial::Reason>(reason), 3, 0.207};
    all << words.instruction(state, true);
  }
  all.removeDuplicates();
  return all;
}

TEST(SubjectWords, EverySentenceIsThereInEveryLanguageAndTellsNoNumber) {
  const QStringList english = everySentence("en");
  EXPECT_EQ(english.size(), 15);
  for (const Language& language : languages()) {
    const QStringList sentences = everySentence(language.code);
    ASSERT_EQ(sentences.size(), english.size()) << "two moments in the same words: " << language.code.toStdString();
    for (int i = 0; i < sentences.size(); ++i) {
      EXPECT_FALSE(sentences[i].isEmpty());
      EXPECT_FALSE(sentences[i].contains(QRegularExpression("\\d"))) << sentences[i].toStdString();
      EXPECT_EQ(sentences[i] == english[i], language.code == "en") << "not in " << language.code.toStdString() << ": " << i;
    }
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
