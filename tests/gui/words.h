#pragma once
#include <QString>

#include "tests/refusal.h"

namespace reachlab::gui {

using reachlab::holds;

/// Whether a text of the window has these words in it, or begins with them.
inline testing::AssertionResult holds(const QString& text, const QString& words) { return holds(text.toStdString(), words.toStdString()); }
inline testing::AssertionResult starts(const QString& text, const QString& words) {
  return testing::AssertionResult(text.startsWith(words)) << '"' << text.toStdString() << "\" begins with \"" << words.toStdString() << '"';
}

}  // namespace reachlab::gui
