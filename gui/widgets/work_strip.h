#pragma once
#include <QProgressBar>
#include <QToolButton>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {

/// Work in the background, its progress, and the button that stops it. Hidden if there is no work.
class WorkStrip : public QWidget {
 public:
  WorkStrip(const QString& name, const QString& button) : what_(new QLabel), bar_(new QProgressBar), stop_(new QToolButton) {
    setObjectName(name);
    auto* row = filling<QHBoxLayout>(this);
    bar_->setFixedWidth(120);
    stop_->setText(button);
    addAll(*row, {what_, bar_, stop_});
    hide();
  }
  /// `percent`: below 0 where nobody knows.
  void tell(const QString& what, int percent) {
    what_->setText(what);
    bar_->setValue(percent);
    bar_->setVisible(percent >= 0);
    show();
  }
  QToolButton& button() { return *stop_; }

 private:
  QLabel* what_;
  QProgressBar* bar_;
  QToolButton* stop_;
};

}  // namespace reachlab::gui::widgets
