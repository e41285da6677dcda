#pragma once
#include <QString>
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

/// The subject's texts, in a language that is independent of the experimenter's. They are large and short and have no number.
class SubjectWords {
 public:
  SubjectWords();
  ~SubjectWords();
  /// A code of languages(). Unknown codes mean English.
  void setLanguage(const QString& code);
  const QString& language() const { return language_; }
  /// The instruction at this moment. Empty during the movement.
  QString instruction(const haptics::TickState& state, bool targetShown) const;
  QString outcome(const trial::TrialResult& result) const;
  /// Texts between blocks and after the last block.
  QString rest() const;
  QString thanks() const;

 private:
  /// Translates an English sentence of the program into the subject's language.
  QString say(const char* english) const;

  QString language_ = "en";
  std::unique_ptr<QTranslator> translator_;
};

}  // namespace reachlab::gui::subject
