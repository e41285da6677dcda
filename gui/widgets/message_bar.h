#pragma once
#include <QLabel>

namespace reachlab::gui::app {

/// The sentence at the top of the window. Hidden if there is no sentence.
class MessageBar : public QLabel {
 public:
  MessageBar() {
    setObjectName(QStringLiteral("message"));
    setWordWrap(true);
    hide();
  }
  /// An error or a warning: red.
  void say(const QString& sentence) { put(sentence, QStringLiteral("#6b2b25")); }
  /// News of a success: blue.
  void tell(const QString& sentence) { put(sentence, QStringLiteral("#24506b")); }
  QString sentence() const { return isHidden() ? QString() : text(); }

 private:
  void put(const QString& sentence, const QString& background) {
    setStyleSheet(QStringLiteral("background: %1; color: white; padding: 8px 12px; font-weight: 600;").arg(background));
    setText(sentence);
    setVisible(!sentence.isEmpty());
  }
};

}  // namespace reachlab::gui::app
