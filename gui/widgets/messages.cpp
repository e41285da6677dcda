#include "gui/widgets/messages.h"

#include <QEvent>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "gui/widgets/named.h"

namespace reachlab::gui::widgets {
namespace {

constexpr int kMost = 4;                       // messages at a time
constexpr int kWidest = 680, kFromBelow = 60;  // [pixel] below them: axes and scale of the scene
constexpr int kDoneMs = 6000, kAttentionMs = 15000;

struct Look {
  const char *name, *mark, *background;
  int milliseconds;  // 0: stays
};
Look lookOf(Grade grade) {
  switch (grade) {
    case Grade::Done: return {"done", "✓", "#1d5138", kDoneMs};
    case Grade::Attention: return {"attention", "!", "#5f4708", kAttentionMs};
    case Grade::Error: break;
  }
  return {"error", "✕", "#7a2720", 0};
}

}  // namespace

Messages::Messages(QWidget& over) : QWidget(&over), over_(over), rows_(filling<QVBoxLayout>(this, 6)) {
  setObjectName("messages");
  over.installEventFilter(this);
  hide();
}

void Messages::say(Grade grade, const QString& sentence) {
  if (sentence.isEmpty()) return;
  for (QWidget* row : findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (row->accessibleDescription() == sentence) delete row;  // shown again as the newest
  while (rows_->count() >= kMost) delete rows_->itemAt(0)->widget();
  const Look look = lookOf(grade);
  auto* row = new QFrame(this);
  row->setObjectName(QLatin1String(look.name));
  row->setAccessibleDescription(sentence);
  row->setStyleSheet(
      QStringLiteral("QFrame { background: %1; border-radius: 6px; } QLabel, QToolButton { color: white; background: transparent; }"
                     "QToolButton { border: none; font-weight: 600; padding: 2px 6px; } QToolButton:focus { border: 1px solid white; }")
          .arg(QLatin1String(look.background)));
  auto* line = new QHBoxLayout(row);
  line->setContentsMargins(12, 8, 6, 8);
  auto* mark = new QLabel(QString::fromUtf8(look.mark));
  mark->setStyleSheet("font-weight: 700;");
  auto* text = new QLabel(sentence);
  text->setWordWrap(true);
  text->setTextFormat(Qt::PlainText);
  text->setTextInteractionFlags(Qt::TextSelectableByMouse);
  text->setFocusPolicy(Qt::NoFocus);
  auto* close = tipped(new QToolButton, "Close this message");
  close->setText("×");
  close->setFocusPolicy(Qt::TabFocus);
  line->addWidget(mark, 0, Qt::AlignTop);
  line->addWidget(text, 1);
  line->addWidget(close, 0, Qt::AlignTop);
  rows_->addWidget(row);
  row->show();  // a layout gives no height to a hidden row
  const auto remove = [this, row] {
    row->hide();
    rows_->removeWidget(row);
    row->deleteLater();
    place();
  };
  connect(close, &QToolButton::clicked, row, remove);
  if (look.milliseconds > 0) QTimer::singleShot(look.milliseconds, row, remove);
  place();
}

void Messages::clear() {
  while (rows_->count() > 0) delete rows_->itemAt(0)->widget();
  place();
}

QString Messages::newest() const {
  return rows_->count() == 0 ? QString() : rows_->itemAt(rows_->count() - 1)->widget()->accessibleDescription();
}

void Messages::place() {
  setVisible(rows_->count() > 0);
  const int width = std::min(kWidest, over_.width() - 24);
  const int height = std::min(rows_->heightForWidth(width), over_.height());
  setGeometry((over_.width() - width) / 2, std::max(0, over_.height() - height - kFromBelow), width, height);
  raise();
}

bool Messages::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize && isVisible()) place();
  return QWidget::eventFilter(watched, event);
}

}  // namespace reachlab::gui::widgets
