#pragma once
#include <gtest/gtest.h>

#include <QAbstractButton>
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

/// Answers the next question by a click on that button. `text` of the question stays to be looked at.
class AnswerBox {
 public:
  explicit AnswerBox(const QString& button)
      : answer_([this, button](QWidget* dialog) {
          auto* box = qobject_cast<QMessageBox*>(dialog);
          if (box == nullptr) return false;
          text_ = box->text();
          for (QAbstractButton* choice : box->buttons())
            if (choice->text().remove(QLatin1Char('&')) == button) return choice->click(), true;
          box->reject();  // no such button: the test sees what was asked
          return false;
        }) {}
  QString text() const { return text_; }

 private:
  QString text_;
  Answer answer_;
};

}  // namespace reachlab::gui
