#include "gui/session/session_strip.h"

#include <QAction>
#include <QLineEdit>
#include <QPushButton>

#include "gui/scene/trial_texts.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::app {
namespace {

QPushButton* buttonOf(QAction* action, const char* name) {
  auto* button = widgets::named<QPushButton>(name);
  button->setFocusPolicy(Qt::TabFocus);  // a click leaves the keys where they are
  const auto follow = [button, action] {
    button->setText(QStringLiteral("%1  (%2)").arg(action->iconText(), action->shortcut().toString(QKeySequence::NativeText)));
    button->setEnabled(action->isEnabled());
    button->setToolTip(action->toolTip());
  };
  follow();
  QObject::connect(action, &QAction::changed, button, follow);
  QObject::connect(button, &QPushButton::clicked, action, &QAction::trigger);
  return button;
}

}  // namespace

SessionStrip::SessionStrip(QAction* next, QAction* abort, QAction* repeat, QAction* end)
    : QToolBar(tr("Session")), run_(new widgets::ElidedLabel), tally_(widgets::named<widgets::ElidedLabel>("tally")),
      note_(widgets::named<QLineEdit>("note")) {
  setObjectName("sessionStrip");
  setMovable(false);
  setFloatable(false);
  toggleViewAction()->setEnabled(false);
  toggleViewAction()->setVisible(false);
  QPushButton* start = buttonOf(next, "next");
  start->setProperty("role", "go");
  start->setMinimumWidth(start->fontMetrics().horizontalAdvance("Next block  (Space)") + 32);  // of the longest words
  auto* body = new QWidget;
  auto* row = new QHBoxLayout(body);
  row->setContentsMargins(8, 4, 8, 4);
  row->setSpacing(6);
  widgets::addAll(*row, {start, buttonOf(abort, "abort"), buttonOf(repeat, "repeat"), buttonOf(end, "end")});
  auto* lines = new QVBoxLayout;
  lines->setSpacing(0);
  run_->setProperty("role", "quiet");
  QFont bold = tally_->font();
  bold.setWeight(QFont::DemiBold);
  tally_->setFont(bold);
  widgets::addAll(*lines, {run_, tally_});
  row->addLayout(lines, 3);
  note_->setPlaceholderText(tr("Note (Enter)"));
  note_->setToolTip(tr("A note that is recorded with its time. Enter keeps it."));
  note_->setMinimumWidth(96);
  note_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);  // the count of results needs the room more
  row->addWidget(note_, 1);
  addWidget(body);
  connect(note_, &QLineEdit::returnPressed, this, [this] {
    const QString text = note_->text().trimmed();
    if (text.isEmpty()) return;
    Q_EMIT noteWritten(text);
    note_->clear();
  });
  clearTally();
  setOpen(false);
}

void SessionStrip::setOpen(bool open) {
  note_->setEnabled(open);
  if (!open) run_->tell(tr("no run is open"));
}

void SessionStrip::showRun(const record::RunConfiguration& run) {
  QString text = tr("Run %1, block %2: %3").arg(run.run).arg(run.block).arg(QString::fromStdString(run.condition));
  if (run.practice) text += tr(" (practice)");
  if (run.day > 0) text += tr(", day %1").arg(run.day);
  run_->tell(text + tr(", seed %1").arg(run.sessionSeed));
}

void SessionStrip::clearTally() {
  successes_ = failures_ = others_ = 0;
  reasons_.clear();
  tally_->tell(tr("No trials yet"));
}

void SessionStrip::count(const trial::TrialResult& result) {
  if (result.outcome == trial::Outcome::Success) ++successes_;
  else if (result.outcome == trial::Outcome::Failure) ++failures_;
  else ++others_;
  if (result.outcome != trial::Outcome::Success) ++reasons_[result.reason];
  const int judged = successes_ + failures_;
  QString text = judged > 0 ? tr("%1 of %2 succeeded (%3 %)").arg(successes_).arg(judged).arg(100.0 * successes_ / judged, 0, 'f', 0)
                            : tr("No trial counts yet");
  if (others_ > 0) text += tr(", %1 did not count").arg(others_);
  QStringList why;
  for (const auto& [reason, count] : reasons_) why << QStringLiteral("%1 × %2").arg(count).arg(scene::reasonText(reason));
  if (!why.isEmpty()) text += ": " + why.join(", ");
  tally_->tell(text);
}

QString SessionStrip::tally() const { return tally_->text(); }

void SessionStrip::beginNote(const QString& words) {
  note_->setText(words);
  note_->setFocus();
  note_->setCursorPosition(static_cast<int>(words.size()));
}

}  // namespace reachlab::gui::app
