#include "gui/plan/start_page.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVariant>
#include <algorithm>

#include "gui/widgets/named.h"
#include "gui/widgets/text_table.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::plan {
namespace {

constexpr int kMostRows = 9, kRowHeight = 25;

QString stateOf(const session::BlockProgress& block) {
  QString text = block.complete() ? StartPage::tr("✓ done") : block.begun() ? StartPage::tr("broken off") : StartPage::tr("to do");
  if (block.practice) text += StartPage::tr(", practice");
  if (block.restSeconds > 0 && !block.complete()) text += StartPage::tr(", after %1 s of rest").arg(block.restSeconds);
  return text;
}

}  // namespace

StartPage::StartPage(QWidget& over) : CardFrame(over, 1.6, 9, 660) {
  setObjectName(QStringLiteral("startPage"));
  auto* who = new QHBoxLayout;
  const auto field = [&](const QString& words, const char* name) {
    auto* made = widgets::named<QLineEdit>(name);
    made->setMaximumWidth(130);
    widgets::addAll(*who, {new QLabel(words), made});
    return made;
  };
  subject_ = field(tr("subject"), "startSubject");
  session_ = field(tr("session"), "startSession");
  summary_ = widgets::named<QLabel>("startSummary");
  widgets::addAll(*who, {nullptr, summary_});
  blocks_ = widgets::makeTextTable("startBlocks", {tr("block"), tr("condition"), tr("trials"), tr("state")}, kRowHeight);
  blocks_->setFocusPolicy(Qt::NoFocus);
  blocks_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
  next_ = widgets::named<QLabel>("startNext");
  next_->setWordWrap(true);
  auto* compose = new QPushButton(tr("Compose…"));
  anew_ = widgets::named<QPushButton>("startAnew", tr("Begin anew"));
  go_ = widgets::named<QPushButton>("startGo");
  go_->setProperty("role", QStringLiteral("go"));
  for (QPushButton* button : {compose, anew_, go_}) button->setFocusPolicy(Qt::NoFocus);  // Space is the trial's
  column_->addLayout(who);
  widgets::addAll(*column_, {blocks_, next_});
  column_->addLayout(widgets::rowOf({compose, nullptr, anew_, go_}));
  for (QLineEdit* edit : {subject_, session_})
    connect(edit, &QLineEdit::editingFinished, this,
            [this] { Q_EMIT placeEdited(subject_->text().trimmed(), session_->text().trimmed()); });
  connect(go_, &QPushButton::clicked, this, [this] {
    if (resumes_) Q_EMIT resumeRequested();
    else Q_EMIT beginRequested();
  });
  connect(anew_, &QPushButton::clicked, this, &StartPage::beginRequested);
  connect(compose, &QPushButton::clicked, this, &StartPage::composeRequested);
}

void StartPage::show(const Shown& shown) {
  const session::SessionProgress& progress = shown.progress;
  title_->setText(tr("Session plan: %1").arg(shown.plan));
  if (!subject_->hasFocus()) subject_->setText(shown.subject);
  if (!session_->hasFocus()) session_->setText(shown.session);
  resumes_ = shown.fault.isEmpty() && progress.begun() && !progress.complete();
  QString summary = tr("%1 of %2 blocks done").arg(progress.blocksDone()).arg(progress.blocks.size());
  if (shown.day > 0) summary = tr("day %1   ").arg(shown.day) + summary;
  summary_->setText(shown.fault.isEmpty() ? summary : QString());
  blocks_->setRowCount(static_cast<int>(progress.blocks.size()));
  const session::BlockProgress* next = nullptr;
  for (int i = 0; i < blocks_->rowCount(); ++i) {
    const session::BlockProgress& block = progress.blocks[static_cast<std::size_t>(i)];
    if (next == nullptr && !block.complete()) next = &block;
    widgets::setTexts(*blocks_, i,
                      {QString::number(block.block), QString::fromStdString(block.condition),
                       QStringLiteral("%1 / %2").arg(block.done).arg(block.trials), stateOf(block)});
    QFont font = blocks_->font();
    font.setBold(next == &block);
    for (int column = 0; column < blocks_->columnCount(); ++column) {
      blocks_->item(i, column)->setFont(font);
      blocks_->item(i, column)->setForeground(widgets::toQColor(block.complete() ? widgets::colours::kFaintText : widgets::colours::kText));
    }
  }
  blocks_->setFixedHeight(blocks_->horizontalHeader()->sizeHint().height() + 4 +
                          kRowHeight * std::clamp(blocks_->rowCount(), 1, kMostRows));
  QString words = shown.fault;
  if (words.isEmpty() && next == nullptr) words = tr("All trials of this session are recorded. Choose another subject or another session.");
  else if (words.isEmpty()) {
    const QString condition = QString::fromStdString(next->condition);
    words =
        resumes_
            ? tr("Continues in block %1, %2, with trial %3 of %4.").arg(next->block).arg(condition).arg(next->done + 1).arg(next->trials)
            : tr("The first block is block %1, %2, with %3 trials.").arg(next->block).arg(condition).arg(next->trials);
  }
  instructions_ = next != nullptr ? QString::fromStdString(next->instructions) : QString();
  if (!instructions_.isEmpty()) words += QLatin1Char('\n') + instructions_;
  next_->setText(words);
  const bool can = shown.fault.isEmpty() && next != nullptr;
  go_->setEnabled(can);
  go_->setText(resumes_ ? tr("Resume  (Space)") : tr("Begin  (Space)"));
  anew_->setVisible(resumes_);
  setVisible(true);
  place();
}

}  // namespace reachlab::gui::plan
