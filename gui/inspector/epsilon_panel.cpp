#include "gui/inspector/epsilon_panel.h"

#include <QLabel>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "gui/plot/criterion_style.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::inspector {
namespace {

enum Column { kName, kPaper, kFitted, kColumns };

}  // namespace

std::optional<double> fittedEpsilon(const analysis::Analysis& analysis, std::size_t condition, predict::Criterion criterion) {
  const auto k = analysis::placeOf(namesOf(analysis.results[condition].candidates), criterion);
  if (!k) return std::nullopt;
  double sum = 0;
  int people = 0;
  for (const analysis::PersonResult& person : analysis.people) {
    if (person.condition != condition || !person.fitted) continue;
    sum += person.fit.candidates[*k].epsilonOfAll;
    ++people;
  }
  return people == 0 ? std::nullopt : std::optional(sum / people);
}

EpsilonPanel::EpsilonPanel(QWidget* parent) : QWidget(parent) {
  auto* layout = widgets::filling<QVBoxLayout>(this, 3);
  table_ = plot::makeCriteriaTable("inspectedCriteria", {tr("criterion"), tr("ε paper"), tr("ε fitted")},
                                   {predict::Criterion::MinHandJerk, predict::Criterion::MinCrackle}, 22);
  table_->horizontalHeaderItem(kPaper)->setToolTip(
      tr("the paper's epsilon of the hand over the chosen trials that count, as in the report's tables [m/s]"));
  table_->horizontalHeaderItem(kFitted)->setToolTip(tr(
      "the fitted epsilon, as in fits.csv: onset, duration and amplitude fitted to each trial; from ten trials of a person on, the mean over people [m/s]"));
  table_->setMinimumSize(290, 110);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  layout->addWidget(table_, 1);
  told_ = widgets::roleLabel("quiet");
  told_->setObjectName("inspectedWords");
  layout->addWidget(told_);
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (item->column() == kName) Q_EMIT chosenChanged();
  });
  clear(tr("Choose trials in the table."));
}

void EpsilonPanel::show(const analysis::Analysis& analysis, std::size_t condition) {
  const QSignalBlocker quiet(table_);
  const analysis::ConditionResult& r = analysis.results[condition];
  int best[kColumns] = {-1, -1, -1};
  double least[kColumns] = {0, 1e300, 1e300};
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto criterion = static_cast<predict::Criterion>(i);
    std::optional<double> paper;
    for (const analysis::EpsilonPlace& place : r.handEpsilon)
      if (r.signals[place.criterion].criterion == criterion) paper = place.epsilon;
    const auto put = [&](int column, const std::optional<double>& value) {
      table_->item(i, column)->setText(value && std::isfinite(*value) ? QString::number(*value, 'f', 4) : "–");
      if (value && *value < least[column]) least[column] = *value, best[column] = i;
    };
    put(kPaper, paper);
    put(kFitted, fittedEpsilon(analysis, condition, criterion));
  }
  for (int i = 0; i < predict::kCriterionCount; ++i)
    for (const int column : {kPaper, kFitted}) {
      QFont font = table_->item(i, column)->font();
      font.setBold(i == best[column]);
      table_->item(i, column)->setFont(font);
    }
  QString words = tr("%1: %2 of the chosen trials count").arg(QString::fromStdString(analysis.conditions[condition].name)).arg(r.used);
  QStringList out;
  for (const auto& [why, count] : r.exclusions) out << tr("%1 × %2").arg(count).arg(QString::fromStdString(why));
  if (!out.isEmpty()) words += tr("; not: %1").arg(out.join(", "));
  const bool anyFitted = best[kFitted] >= 0;
  if (!anyFitted) words += tr(". ε is fitted when a person has at least %1 counted trials").arg(analysis::kFewestTrials);
  if (r.onlyFailures) words += tr(". No trial succeeded, so the failed trials are described");
  told_->setText(words + QLatin1Char('.'));
}

void EpsilonPanel::clear(const QString& why) {
  const QSignalBlocker quiet(table_);
  for (int i = 0; i < predict::kCriterionCount; ++i)
    for (const int column : {kPaper, kFitted}) table_->item(i, column)->setText({});
  told_->setText(why);
}

std::vector<predict::Criterion> EpsilonPanel::chosen() const { return plot::chosenIn(*table_); }

predict::Criterion EpsilonPanel::first() const {
  const std::vector<predict::Criterion> all = chosen();
  return all.empty() ? predict::Criterion::MinHandJerk : all.front();
}

}  // namespace reachlab::gui::inspector
