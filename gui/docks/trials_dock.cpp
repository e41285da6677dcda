#include "gui/docks/trials_dock.h"

#include <QHeaderView>
#include <QInputDialog>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "gui/scene/trial_texts.h"
#include "gui/widgets/theme.h"
#include "gui/widgets/named.h"
#include "gui/widgets/text_table.h"

namespace reachlab::gui::docks {
namespace {

enum Column { kNumber, kOutcome, kTime, kEpsilon, kMark };

QColor inkOf(trial::Outcome outcome) {
  using namespace widgets;
  switch (outcome) {
    case trial::Outcome::Success: return toQColor(colours::kGreen);
    case trial::Outcome::Failure: return widgets::faultInk();
    default: return toQColor(colours::kFaintText);
  }
}

QString outcomeWords(const trial::TrialResult& result) {
  return result.outcome == trial::Outcome::Success ? "✓" : QStringLiteral("✗ %1").arg(scene::reasonText(result.reason));
}

}  // namespace

TrialsDock::TrialsDock(QWidget* parent) : Dock("Trials", "trialsDock", parent) {
  table_ = widgets::makeTextTable("trials", {"trial", "outcome", "t [s]", "ε", QString()}, 23);
  table_->horizontalHeaderItem(kTime)->setToolTip("from the hand's onset to the end [s]");
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->horizontalHeader()->setSectionResizeMode(kOutcome, QHeaderView::Stretch);
  table_->setToolTip("double click: a note on this trial");
  table_->setMinimumSize(180, 90);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  auto* body = new QWidget;
  auto* layout = widgets::filling<QVBoxLayout>(body, 2);
  layout->addWidget(table_, 1);
  const auto makeButton = [&](const QString& text, const char* name, const QString& tip, auto slot) {
    auto* made = widgets::tipped(widgets::named<QToolButton>(name), tip);
    made->setText(text);
    made->setFocusPolicy(Qt::NoFocus);
    connect(made, &QToolButton::clicked, this, slot);
    return made;
  };
  layout->addLayout(widgets::rowOf(
      {makeButton(tr("⚑ Flag"), "flagTrial", tr("flags the chosen trial, or the newest trial, to look at it again"), &TrialsDock::flag),
       makeButton(tr("Exclude…"), "excludeTrial", tr("excludes the trial from the analysis, with a reason"), &TrialsDock::exclude),
       makeButton(tr("Undo repeat"), "undoRepeat", tr("cancels the last planned repeat"), &TrialsDock::takeBackRequested), nullptr}));
  setBody(body, false);
  connect(table_, &QTableWidget::cellDoubleClicked, this,
          [this](int row, int) { Q_EMIT noteRequested(rows_[static_cast<std::size_t>(row)].number); });
}

void TrialsDock::clear() {
  rows_.clear();
  table_->setRowCount(0);
}

void TrialsDock::add(int number, const trial::TrialResult& result) {
  rows_.push_front({number, result, {}, {}});
  table_->insertRow(0);
  fill(0);
}

const TrialsDock::Row* TrialsDock::chosen() const {
  if (rows_.empty()) return nullptr;
  const QList<QTableWidgetItem*> items = table_->selectedItems();
  return &rows_[static_cast<std::size_t>(items.isEmpty() ? 0 : items.front()->row())];
}

void TrialsDock::flag() {
  if (const Row* row = chosen()) Q_EMIT markRequested(row->number, [](record::TrialMark& mark) { mark.flagged = !mark.flagged; });
}

void TrialsDock::exclude() {
  const Row* row = chosen();
  if (row == nullptr) return;
  const int number = row->number;
  bool fine = false;
  const QString reason =
      QInputDialog::getText(this, tr("Exclude trial %1").arg(number), tr("Reason for the exclusion (empty: the trial counts):"),
                            QLineEdit::Normal, QString::fromStdString(row->mark.excluded), &fine);
  if (fine) Q_EMIT markRequested(number, [&](record::TrialMark& mark) { mark.excluded = reason.trimmed().toStdString(); });
}

void TrialsDock::setMark(int number, const record::TrialMark& mark) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].number != number) continue;
    rows_[i].mark = mark;
    fill(static_cast<int>(i));
  }
}

void TrialsDock::setErrors(const std::vector<std::optional<double>>& errors) {
  if (rows_.empty()) return;
  rows_.front().errors = errors;
  fill(0);
}

void TrialsDock::showCriterion(std::size_t index, const QString& title) {
  criterion_ = index;
  table_->horizontalHeaderItem(kEpsilon)->setToolTip(QStringLiteral("the paper's epsilon of the hand beside %1 [m/s]").arg(title));
  for (int row = 0; row < table_->rowCount(); ++row) fill(row);
}

void TrialsDock::fill(int tableRow) {
  const Row& row = rows_[static_cast<std::size_t>(tableRow)];
  const bool moved = row.result.onsetTick > 0;
  const std::optional<double> error = criterion_ < row.errors.size() ? row.errors[criterion_] : std::nullopt;
  QStringList marks;
  if (row.mark.flagged) marks << "⚑";
  if (!row.mark.excluded.empty()) marks << tr("excluded");
  widgets::setTexts(
      *table_, tableRow,
      {QString::number(row.number), outcomeWords(row.result), moved ? QString::number(row.result.movementTime, 'f', 2) : QString(),
       error ? QString::number(*error, 'f', 4) : QString(), marks.join(QLatin1Char(' '))});
  for (const Column column : {kNumber, kTime, kEpsilon, kMark})
    table_->item(tableRow, column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  table_->item(tableRow, kOutcome)->setForeground(inkOf(row.result.outcome));
  table_->item(tableRow, kOutcome)->setToolTip(scene::outcomeText(row.result));
  table_->item(tableRow, kMark)->setToolTip(QString::fromStdString(row.mark.excluded));
}

}  // namespace reachlab::gui::docks
