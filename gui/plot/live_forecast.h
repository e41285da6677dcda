#pragma once
#include <QObject>
#include <functional>
#include <optional>
#include <vector>

#include "gui/plot/line_style.h"
#include "gui/plot/trial_errors.h"
#include "gui/widgets/newest_work.h"

namespace reachlab::gui::plot {

/// The criteria's predictions for the experiment that holds, computed beside the window, and the trials that are compared with them.
class LiveForecast : public QObject {
  Q_OBJECT
 public:
  /// Begins anew for this experiment. Work under way is dropped.
  void setExperiment(const experiment::CompiledExperiment& experiment);
  /// True once all predictions of the present experiment are computed.
  bool isReady() const { return !work_.busy(); }
  /// Empty while they are being computed.
  const std::vector<CriterionForecast>& forecasts() const { return forecasts_; }
  /// The lines of these criteria, for the plot.
  std::vector<PredictedLine> lines(const std::vector<predict::Criterion>& criteria) const;
  /// A trial that has ended: `compared` follows, at once or when the predictions are there.
  void compare(const std::vector<TracePoint>& points, const constraints::TaskPath& path, const TrialSpan& span, bool succeeded);

 Q_SIGNALS:
  /// The predictions are there, or (an empty list) begun anew.
  void changed();
  /// The paper's error of the trial's hand for each forecast, in their order. [m/s]
  void compared(const std::vector<std::optional<double>>& errors, bool succeeded);

 private:
  void tellCompared();

  std::optional<experiment::CompiledExperiment> experiment_;
  std::vector<CriterionForecast> forecasts_;
  std::function<void()> ended_;  // compares the trial
  widgets::NewestWork work_{*this};
};

}  // namespace reachlab::gui::plot
