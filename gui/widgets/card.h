#pragma once
#include <QFrame>
#include <functional>
#include <vector>

#include "gui/widgets/qt_names.h"

namespace reachlab::gui::widgets {

/// A panel with a title over the middle of a widget. Hidden until it is shown.
class CardFrame : public QFrame {
 protected:
  /// `titleScale`: size of the title's letters by the usual size. `widest`: [px].
  CardFrame(QWidget& over, double titleScale, int spacing, int widest);
  bool eventFilter(QObject* watched, QEvent* event) override;
  /// Fits the shown panel to its words and to the widget below.
  void place();

  QWidget& over_;
  QLabel* title_;
  QVBoxLayout* column_;  // from the title down

 private:
  int widest_;
};

/// A panel with sentences and buttons.
class Card : public CardFrame {
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

 private:
  QLabel* text_;
  QHBoxLayout* buttons_;
};

}  // namespace reachlab::gui::widgets
