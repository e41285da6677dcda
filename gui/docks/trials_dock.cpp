#include "gui/docks/trials_dock.h"

#include <QHeaderView>
#include <QTableWidget>

#include "gui/scene/trial_texts.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::docks {
namespace {

enum Column { kNumber, kOutcome, kTime, kEpsilon, kColumns };

QColor inkOf(trial::Outcome outcome) {
  using namespace widgets;
  switch (outcome) {
    case trial::Outcome::Success: return toQColor(colours::kGreen);
    case trial::Outcome::Failure: return QColor(255, 157, 140);
    default: return toQColor(colours::kFaintText);
  }
}

QString outcomeWords(const trial::TrialResult& result) {
  return result.outcome == trial::Outcome::Success ? QStringLiteral("✓") : QStringLiteral("✗ %1").arg(scene::reasonText(result.reason));
}

}  // namespace

TrialsDock::TrialsDock(QWidget* parent) : Dock(QStringLiteral("Trials"), QStringLiteral("trialsDock"), parent) {
  table_ = new QTableWidget(0, kColumns);
  table_->setObjectName(QStringLiteral("trials"));
  table_->setHorizontalHeaderLabels({QStringLiteral("trial"), QStringLiteral("outcome"), QStringLiteral("t [s]"), QStringLiteral("ε")});
  table_->horizontalHeaderItem(kTime)->setToolTip(QStringLiteral("from the hand's onset to the end [s]"));
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(23);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setShowGrid(false);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(kOutcome, QHeaderView::Stretch);
  table_->setToolTip(QStringLiteral("double click: a note on this trial"));
  table_->setMinimumSize(180, 90);
  setBody(table_, false);
  connect(table_, &QTableWidget::cellDoubleClicked, this,
          [this](int row, int) { Q_EMIT noteRequested(rows_[rows_.size() - 1 - static_cast<std::size_t>(row)].number); });
}

void TrialsDock::clear() {
  rows_.clear();
  table_->setRowCount(0);
}

void TrialsDock::add(int number, const trial::TrialResult& result) {
  rows_.push_back({number, result, {}});
  table_->insertRow(0);
  for (int column = 0; column < kColumns; ++column) {
    auto* item = new QTableWidgetItem;
    item->setTextAlignment((column == kOutcome ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    table_->setItem(0, column, item);
  }
  fill(0);
}

void TrialsDock::setErrors(const std::vector<std::optional<double>>& errors) {
  if (rows_.empty()) return;
  rows_.back().errors = errors;
  fill(0);
}

void TrialsDock::showCriterion(std::size_t index, const QString& title) {
  criterion_ = index;
  table_->horizontalHeaderItem(kEpsilon)->setToolTip(QStringLiteral("the paper's epsilon of the hand beside %1 [m/s]").arg(title));
  for (int row = 0; row < table_->rowCount(); ++row) fill(row);
}

void TrialsDock::fill(int tableRow) {
  const Row& row = rows_[rows_.size() - 1 - static_cast<std::size_t>(tableRow)];
  const bool moved = row.result.onsetTick > 0;
  const std::optional<double> error = criterion_ < row.errors.size() ? row.errors[criterion_] : std::nullopt;
  table_->item(tableRow, kNumber)->setText(QString::number(row.number));
  table_->item(tableRow, kOutcome)->setText(outcomeWords(row.result));
  table_->item(tableRow, kOutcome)->setForeground(inkOf(row.result.outcome));
  table_->item(tableRow, kOutcome)->setToolTip(scene::outcomeText(row.result));
  table_->item(tableRow, kTime)->setText(moved ? QString::number(row.result.movementTime, 'f', 2) : QString());
  table_->item(tableRow, kEpsilon)->setText(error ? QString::number(*error, 'f', 4) : QString());
}

}  // namespace reachlab::gui::docks
