#include "gui/docks/prediction_dock.h"

#include <QSignalBlocker>
#include <QTableWidget>
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

PredictionDock::PredictionDock(QWidget* parent) : Dock("Predictions", "predictionDock", parent) {
  table_ =
      plot::makeCriteriaTable("criteria", {"criterion", "peak", "ε last", "ε run", "ε fit"}, {predict::Criterion::MinHandJerk}, kRowHeight);
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
  setBody(widgets::columnOf({table_, widgets::roleLabel("quiet", "m/s; dashed on the plot where ticked"), nullptr}));
  connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (item->column() == kName) Q_EMIT chosenChanged();
  });
}

void PredictionDock::setForecasts(const std::vector<plot::CriterionForecast>& forecasts) {
  const QSignalBlocker quiet(table_);
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    QTableWidgetItem* peak = table_->item(i, kPeak);
    peak->setText(forecasts.empty() ? "…" : "–");
    if (static_cast<std::size_t>(i) >= forecasts.size()) continue;
    const plot::CriterionForecast& forecast = forecasts[static_cast<std::size_t>(i)];
    if (forecast.prediction) peak->setText(speed(forecast.prediction->handPeak));
    QString why = QString::fromStdString(forecast.refusal);
    if (forecast.prediction)
      for (const std::string& warning : forecast.prediction->warnings) why += QString::fromStdString(warning) + QLatin1Char('\n');
    QTableWidgetItem* name = table_->item(i, kName);
    name->setToolTip(text(predict::describe(forecast.criterion)) + (why.isEmpty() ? QString() : "\n\n" + why.trimmed()));
    name->setForeground(forecast.prediction ? plot::colourOf(forecast.criterion) : widgets::toQColor(widgets::colours::kNeutral));
  }
}

void PredictionDock::addErrors(const std::vector<std::optional<double>>& errors, bool succeeded) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].latest = i < errors.size() ? errors[i] : std::nullopt;
    if (!rows_[i].latest) continue;
    Sum& sum = succeeded ? rows_[i].succeeded : rows_[i].failed;
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
  rows_ = {};
  fillErrors();
}

void PredictionDock::fillErrors() {
  const QSignalBlocker quiet(table_);
  std::optional<double> best;
  bool any = false;
  for (const Row& row : rows_) {
    if (row.latest && (!best || *row.latest < *best)) best = row.latest;
    any = any || row.succeeded.count > 0;
  }
  for (int i = 0; i < predict::kCriterionCount; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    QTableWidgetItem *last = table_->item(i, kLast), *all = table_->item(i, kAll);
    last->setText(row.latest ? speed(*row.latest) : QString());
    QFont font = table_->font();
    font.setBold(row.latest && row.latest == best);
    last->setFont(font);
    const Sum& sum = any ? row.succeeded : row.failed;
    all->setText(sum.count > 0 ? speed(std::sqrt(sum.squares / sum.count)) : QString());
    all->setForeground(any ? palette().color(QPalette::Text) : widgets::toQColor(widgets::colours::kNeutral));
  }
}

std::vector<predict::Criterion> PredictionDock::chosen() const { return plot::chosenIn(*table_); }

}  // namespace reachlab::gui::docks
