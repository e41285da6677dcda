#include "gui/plot/live_forecast.h"

#include <algorithm>

#include "gui/plot/criterion_style.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::plot {

void LiveForecast::setExperiment(const experiment::CompiledExperiment& experiment) {
  experiment_ = experiment;
  forecasts_.clear();
  ended_ = {};
  Q_EMIT changed();
  const auto computed = std::make_shared<std::vector<CriterionForecast>>();
  work_.begin([experiment, computed](const widgets::NewestWork::Turn& turn) { *computed = forecastAll(experiment, turn.stop); },
              [this, computed](const QString&) {
                forecasts_ = std::move(*computed);
                Q_EMIT changed();
                tellCompared();
              });
}

void LiveForecast::tellCompared() {
  if (ended_ && isReady()) std::exchange(ended_, {})();
}

std::vector<PredictedLine> LiveForecast::lines(const std::vector<predict::Criterion>& criteria) const {
  std::vector<PredictedLine> lines;
  for (const CriterionForecast& forecast : forecasts_) {
    if (!forecast.prediction || std::find(criteria.begin(), criteria.end(), forecast.criterion) == criteria.end()) continue;
    PredictedLine line{titleOf(forecast.criterion), styleOf(forecast.criterion)};
    constexpr int kParts = 240;
    for (int i = 0; i <= kParts; ++i) {
      const double t = forecast.prediction->duration * i / kParts;
      line.x.push_back(t);
      line.y.push_back(forecast.prediction->handAt(t).velocity);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void LiveForecast::compare(const std::vector<TracePoint>& points, const constraints::TaskPath& path, const TrialSpan& span,
                           bool succeeded) {
  ended_ = [this, points, path, span, succeeded] {
    const experiment::Task task = experiment_->experiment().task.value_or(experiment::Task{});
    Q_EMIT compared(computeHandErrors(points, path, forecasts_, task, span), succeeded);
  };
  tellCompared();
}

}  // namespace reachlab::gui::plot
