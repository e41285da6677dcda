#pragma once
#include <gtest/gtest.h>

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QMessageBox>
#include <QTimer>
#include <functional>

namespace reachlab::gui {

/// Answers the next dialog that is opened while this lives, and one is to be opened. `answer` says whether it was the expected dialog.
class Answer {
 public:
  explicit Answer(const std::function<bool(QWidget*)>& answer) {
    QObject::connect(&timer_, &QTimer::timeout, [this, answer] {
      QWidget* dialog = QApplication::activeModalWidget();
      if (dialog != nullptr && answer(dialog)) timer_.stop(), answered_ = true;
    });
    timer_.start(10);
  }
  ~Answer() { EXPECT_TRUE(answered_) << "no dialog was opened"; }

 private:
  QTimer timer_;
  bool answered_ = false;
};

/// Answers the question that `work` makes the window ask by a click on that button. What was asked.
template <class Work>
QString answered(const QString& button, const Work& work) {
  QString asked;
  const Answer answer([&](QWidget* dialog) {
    auto* box = qobject_cast<QMessageBox*>(dialog);
    if (box == nullptr) return false;
    asked = box->text();
    for (QAbstractButton* choice : box->buttons())
      if (choice->text().remove(QLatin1Char('&')) == button) return choice->click(), true;
    box->reject();  // no such button: the test sees what was asked
    return false;
  });
  work();
  return asked;
}

/// Triggers the action, fills in the dialog that it opens, and accepts it.
template <class Dialog, class FillIn>
void triggerWith(QAction* action, const FillIn& fillIn) {
  const Answer answer([&](QWidget* box) {
    auto* dialog = qobject_cast<Dialog*>(box);
    if (dialog == nullptr) return false;
    fillIn(*dialog);
    static_cast<QDialog*>(dialog)->accept();
    return true;
  });
  action->trigger();
}

}  // namespace reachlab::gui
