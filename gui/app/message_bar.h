#pragma once
#include <QLabel>

namespace reachlab::gui::app {

/// The sentence at the top of the window; hidden while there is none.
class MessageBar : public QLabel {
 public:
  MessageBar() {
    setObjectName(QStringLiteral("message"));
    setStyleSheet(QStringLiteral("background: #6b2b25; color: white; padding: 8px 12px; font-weight: 600;"));
    setWordWrap(true);
    hide();
  }
  void say(const QString& sentence) {
    setText(sentence);
    setVisible(!sentence.isEmpty());
  }
  QString sentence() const { return isHidden() ? QString() : text(); }
};

}  // namespace reachlab::gui::app
