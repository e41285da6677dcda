#pragma once
#include <QFrame>
#include <functional>
#include <vector>

class QHBoxLayout;
class QLabel;

namespace reachlab::gui::widgets {

/// A panel over the middle of a widget, with a title, sentences and buttons. Hidden until it is shown.
class Card : public QFrame {
 public:
  struct Choice {
    QString title, name;  // the button's words and object name
    std::function<void()> act;
  };
  explicit Card(QWidget& over);
  /// Shows the card. The last choice is the usual one, and gets the keys if `takesKeys`. Every choice closes the card.
  void offer(const QString& title, const QString& text, const std::vector<Choice>& choices, bool takesKeys);
  /// Closes the card and gives the keys back to the widget below.
  void close();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void place();
  QWidget& over_;
  QLabel *title_, *text_;
  QHBoxLayout* buttons_;
};

}  // namespace reachlab::gui::widgets
