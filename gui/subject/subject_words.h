#pragma once
#include <QString>
#include <QStringList>
#include <memory>
#include <vector>

#include "sim/haptics/tick_state.h"

class QTranslator;

namespace reachlab::gui::subject {

/// A language that subjects can be spoken to in: "de" and how it calls itself.
struct Language {
  QString code, name;
};
const std::vector<Language>& languages();

/// What the subject reads, in a language of its own, whatever the experimenter's is: large, few words, no number.
class SubjectWords {
 public:
  SubjectWords();
  ~SubjectWords();
  /// A code of languages(); another one is English.
  void setLanguage(const QString& code);
  const QString& language() const { return language_; }
  /// What is to be done at this moment; empty while the movement is under way.
  QString instruction(const haptics::TickState& state, bool targetShown) const;
  QString outcome(const trial::TrialResult& result) const;
  /// Between blocks, and after the last.
  QString rest() const;
  QString thanks() const;
  /// A sentence that stands in the program in English, in the subject's language.
  QString say(const char* english) const;

 private:
  QString language_ = QStringLiteral("en");
  std::unique_ptr<QTranslator> translator_;
};

/// Every sentence, in English: what a translation must have.
const std::vector<const char*>& subjectSentences();

}  // namespace reachlab::gui::subject
