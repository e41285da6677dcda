#include "gui/widgets/card.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QVariant>
#include <QVBoxLayout>
#include <algorithm>

namespace reachlab::gui::widgets {

Card::Card(QWidget& over) : QFrame(&over), over_(over), title_(new QLabel), text_(new QLabel), buttons_(new QHBoxLayout) {
  setProperty("role", "card");
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(24, 18, 24, 18);
  layout->setSpacing(12);
  QFont large = title_->font();
  large.setPointSizeF(1.5 * large.pointSizeF());
  large.setBold(true);
  title_->setFont(large);
  title_->setObjectName("cardTitle");
  text_->setObjectName("cardText");
  for (QLabel* label : {title_, text_}) {
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
    layout->addWidget(label);
  }
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setFocusPolicy(Qt::NoFocus);
  layout->addLayout(buttons_);
  over.installEventFilter(this);
  hide();
}

void Card::offer(const QString& title, const QString& text, const std::vector<Choice>& choices, bool takesKeys) {
  title_->setText(title);
  text_->setText(text);
  while (QLayoutItem* item = buttons_->takeAt(0)) {
    if (item->widget() != nullptr) item->widget()->deleteLater();
    delete item;
  }
  buttons_->addStretch(1);
  QPushButton* usual = nullptr;
  for (const Choice& choice : choices) {
    usual = new QPushButton(choice.title);
    usual->setObjectName(choice.name);
    usual->setAutoDefault(true);  // Enter presses it as well
    connect(usual, &QPushButton::clicked, this, [this, act = choice.act] {
      close();
      act();
    });
    buttons_->addWidget(usual);
  }
  show();
  place();
  if (usual == nullptr) return;
  usual->setProperty("role", "go");
  if (takesKeys) usual->setFocus(Qt::OtherFocusReason);
}

void Card::close() {
  if (isHidden()) return;
  const bool had = isAncestorOf(window()->focusWidget());
  hide();
  if (had) over_.setFocus(Qt::OtherFocusReason);
}

void Card::place() {
  setFixedWidth(std::clamp(over_.width() - 30, 300, 560));
  layout()->activate();
  const int height = layout()->heightForWidth(width());
  setGeometry((over_.width() - width()) / 2, std::max(8, (over_.height() - height) / 2), width(), height);
  raise();
}

bool Card::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) QTimer::singleShot(0, this, &Card::place);  // above what the widget raises
  return QFrame::eventFilter(watched, event);
}

}  // namespace reachlab::gui::widgets
