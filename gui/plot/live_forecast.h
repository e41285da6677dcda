#pragma once
#include <QObject>
#include <future>
#include <optional>
#include <stop_token>
#include <vector>

#include "gui/plot/trial_errors.h"
#include "gui/plot/velocity_plot.h"

namespace reachlab::gui::plot {

/// The criteria's predictions for the experiment that holds, computed beside the window, and the trials that are compared with them.
class LiveForecast : public QObject {
  Q_OBJECT
 public:
  ~LiveForecast() override;

  /// Begins anew for this experiment. Work under way is dropped.
  void setExperiment(const experiment::CompiledExperiment& experiment);
  /// Takes over finished computations. Called by the frame timer. Never waits.
  void poll();
  /// True once all predictions of the present experiment are computed.
  bool isReady() const { return !stale_ && !computing_.valid(); }
  /// Empty while they are being computed.
  const std::vector<CriterionForecast>& forecasts() const { return forecasts_; }
  /// The lines of these criteria, for the plot.
  std::vector<VelocityPlot::Line> lines(const std::vector<predict::Criterion>& criteria) const;
  /// A trial that has ended: `compared` follows, at once or when the predictions are there.
  void compare(const std::vector<TracePoint>& points, const constraints::TaskPath& path, const TrialSpan& span, bool succeeded);

 Q_SIGNALS:
  /// The predictions are there, or (an empty list) begun anew.
  void changed();
  /// The paper's error of the trial's hand for each forecast, in their order. [m/s]
  void compared(const std::vector<std::optional<double>>& errors, bool succeeded);

 private:
  struct Trial {
    std::vector<TracePoint> points;
    constraints::TaskPath path;
    TrialSpan span;
    bool succeeded = false;
  };

  std::optional<experiment::CompiledExperiment> experiment_;
  std::vector<CriterionForecast> forecasts_;
  std::stop_source stop_;
  std::future<std::vector<CriterionForecast>> computing_;
  bool stale_ = false;
  std::optional<Trial> ended_;
};

}  // namespace reachlab::gui::plot
