#include "gui/widgets/card.h"

#include <QEvent>
#include <QPushButton>
#include <QTimer>
#include <QVariant>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {

CardFrame::CardFrame(QWidget& over, double titleScale, int spacing, int widest)
    : QFrame(&over), over_(over), title_(new QLabel), column_(new QVBoxLayout(this)), widest_(widest) {
  setProperty("role", "card");
  column_->setContentsMargins(24, 18, 24, 18);
  column_->setSpacing(spacing);
  QFont large = title_->font();
  large.setPointSizeF(titleScale * large.pointSizeF());
  large.setBold(true);
  title_->setFont(large);
  column_->addWidget(title_);
  over.installEventFilter(this);
  hide();
}

void CardFrame::place() {
  setFixedWidth(std::clamp(over_.width() - 30, 300, widest_));
  layout()->activate();
  const int height = layout()->heightForWidth(width());
  setGeometry((over_.width() - width()) / 2, std::max(8, (over_.height() - height) / 2), width(), height);
  raise();
}

bool CardFrame::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) QTimer::singleShot(0, this, &CardFrame::place);  // above what the widget raises
  return QFrame::eventFilter(watched, event);
}

Card::Card(QWidget& over) : CardFrame(over, 1.5, 12, 560), text_(named<QLabel>("cardText")), buttons_(new QHBoxLayout) {
  title_->setObjectName("cardTitle");
  for (QLabel* label : {title_, text_}) {
    label->setWordWrap(true);
    label->setTextFormat(Qt::PlainText);
  }
  column_->addWidget(text_);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text_->setFocusPolicy(Qt::NoFocus);
  column_->addLayout(buttons_);
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

}  // namespace reachlab::gui::widgets
