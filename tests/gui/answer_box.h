#pragma once
#include <QAbstractButton>
#include <QApplication>
#include <QMessageBox>
#include <QTimer>
#include <memory>

namespace reachlab::gui {

/// Whoever opens the next question is answered by a click on that button; `text` of the question stays to be looked at.
class AnswerBox {
 public:
  explicit AnswerBox(const QString& button) : button_(button) {
    QObject::connect(&timer_, &QTimer::timeout, [this] { look(); });
    timer_.start(10);
  }
  bool asked() const { return !text_.isEmpty(); }
  QString text() const { return text_; }

 private:
  void look() {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    text_ = box->text();
    for (QAbstractButton* button : box->buttons())
      if (button->text().remove(QLatin1Char('&')) == button_) return timer_.stop(), button->click();
    box->reject();  // no such button: the test sees what was asked
  }

  QString button_, text_;
  QTimer timer_;
};

}  // namespace reachlab::gui
