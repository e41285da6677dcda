#include "gui/docks/prediction_dock.h"

#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/plot/criterion_style.h"
#include "gui/widgets/named.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::docks {
namespace {

enum Column { kName, kPeak, kLast, kAll, kFitted };
constexpr int kRowHeight = 23;

QString speed(double metresPerSecond) { return QString::number(metresPerSecond, 'f', 4); }

QString text(std::string_view s) { return QString::fromUtf8(s.data(), static_cast<int>(s.size())); }

}  // namespace

PredictionDock::PredictionDock(QWidget* parent)
    : Dock("Predictions", "predictionDock", parent), latest_(predict::kCriterionCount), succeeded_(predict::kCriterionCount),
      failed_(predict::kCriterionCount) {
  auto* body = new QWidget;
  auto* layout = new QVBoxLayout(body);
  table_ = plot::makeCriteriaTable({"criterion", "peak", "ε last", "ε run", "ε fit"}, {predict::Criterion::MinHandJerk}, kRowHeight);
  table_->setObjectName("criteria");
  table_->horizontalHeaderItem(kPeak)->setToolTip("predicted peak velocity of the hand [m/s]");
  table_->horizontalHeaderItem(kLast)->setToolTip(
      "the paper's epsilon of the last trial: RMS difference of the hand's velocity, time-scaled [m/s]");
  table_->horizontalHeaderItem(kAll)->setToolTip(
      "the paper's epsilon over the trials of this run that succeeded, as in reach analyze; grey: over failed trials, until a trial has succeeded [m/s]");
  table_->horizontalHeaderItem(kFitted)->setToolTip(
      "the fitted epsilon over the trials of this run that succeeded, from ten on, as in reach analyze: onset, duration and amplitude "
      "fitted to each trial [m/s]");
  table_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  for (int i = 0; i < predict::kCriterionCount; ++i)
    table_->item(i, kName)->setToolTip(text(predict::describe(static_cast<predict::Criterion>(i))));
  table_->setFixedHeight(predict::kCriterionCount * kRowHeight + 30);
  widgets::addAll(*layout, {table_, widgets::roleLabel("quiet", "m/s; dashed on the plot where ticked")});
  layout->addStretch();
  setBody(body);
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (item->column() == kName) Q_EMIT chosenChanged();
  });
}

void PredictionDock::setForecasts(const std::vector<plot::CriterionForecast>& forecasts) {
  const QSignalBlocker quiet(table_);
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    QTableWidgetItem* peak = table_->item(i, kPeak);
    peak->setText(forecasts.empty() ? "…" : "–");
    for (const plot::CriterionForecast& forecast : forecasts) {
      if (static_cast<int>(forecast.criterion) != i) continue;
      if (forecast.prediction) peak->setText(speed(forecast.prediction->handPeak));
      QString why = QString::fromStdString(forecast.refusal);
      if (forecast.prediction)
        for (const std::string& warning : forecast.prediction->warnings) why += QString::fromStdString(warning) + QLatin1Char('\n');
      table_->item(i, kName)->setToolTip(text(predict::describe(forecast.criterion)) +
                                         (why.isEmpty() ? QString() : "\n\n" + why.trimmed()));
      table_->item(i, kName)->setForeground(forecast.prediction ? plot::colourOf(forecast.criterion)
                                                                : widgets::toQColor(widgets::colours::kNeutral));
    }
  }
}

void PredictionDock::addErrors(const std::vector<std::optional<double>>& errors, bool succeeded) {
  latest_.assign(predict::kCriterionCount, std::nullopt);
  for (std::size_t i = 0; i < errors.size() && i < latest_.size(); ++i) {
    latest_[i] = errors[i];
    if (!errors[i]) continue;
    Sum& sum = (succeeded ? succeeded_ : failed_)[i];
    sum.squares += *errors[i] * *errors[i];
    ++sum.count;
  }
  fillErrors();
}

void PredictionDock::setFitted(const std::vector<std::optional<double>>& fitted) {
  const QSignalBlocker quiet(table_);
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto k = static_cast<std::size_t>(i);
    table_->item(i, kFitted)->setText(k < fitted.size() && fitted[k] ? speed(*fitted[k]) : QString());
  }
}

void PredictionDock::clearErrors() {
  setFitted({});
  latest_.assign(predict::kCriterionCount, std::nullopt);
  succeeded_.assign(predict::kCriterionCount, {});
  failed_.assign(predict::kCriterionCount, {});
  fillErrors();
}

void PredictionDock::fillErrors() {
  const QSignalBlocker quiet(table_);
  std::optional<double> best;
  for (const auto& error : latest_)
    if (error && (!best || *error < *best)) best = error;
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const auto k = static_cast<std::size_t>(i);
    QTableWidgetItem* last = table_->item(i, kLast);
    last->setText(latest_[k] ? speed(*latest_[k]) : QString());
    QFont font = table_->font();
    font.setBold(latest_[k] && latest_[k] == best);
    last->setFont(font);
    const bool any = std::any_of(succeeded_.begin(), succeeded_.end(), [](const Sum& s) { return s.count > 0; });
    const Sum& sum = (any ? succeeded_ : failed_)[k];
    table_->item(i, kAll)->setText(sum.count > 0 ? speed(std::sqrt(sum.squares / sum.count)) : QString());
    table_->item(i, kAll)->setForeground(any ? palette().color(QPalette::Text) : widgets::toQColor(widgets::colours::kNeutral));
  }
}

std::vector<predict::Criterion> PredictionDock::chosen() const { return plot::chosenIn(*table_); }

}  // namespace reachlab::gui::docks
