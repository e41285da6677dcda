#pragma once
#include <array>
#include <optional>
#include <vector>

#include "gui/docks/dock.h"
#include "gui/plot/trial_errors.h"

class QTableWidget;

namespace reachlab::gui::docks {

/// The criteria: which are drawn on the plot, and how far the last trial and all trials of the run were from each. Knows no simulator.
class PredictionDock : public Dock {
  Q_OBJECT
 public:
  explicit PredictionDock(QWidget* parent = nullptr);
  /// While they are being computed: an empty list.
  void setForecasts(const std::vector<plot::CriterionForecast>& forecasts);
  /// The paper's epsilon of a trial for each criterion, in the order of the forecasts [m/s]. The run's epsilon is over successful trials,
  /// as in `reach analyze`, and over failed trials as long as none of the trials succeeded.
  void addErrors(const std::vector<std::optional<double>>& errors, bool succeeded);
  /// The fitted epsilon over the trials of the run that succeeded, one a criterion [m/s].
  void setFitted(const std::vector<std::optional<double>>& fitted);
  void clearErrors();
  std::vector<predict::Criterion> chosen() const;

 Q_SIGNALS:
  void chosenChanged();

 private:
  void fillErrors();

  QTableWidget* table_;
  struct Sum {
    double squares = 0;  // so that the root of the mean is the paper's epsilon of the series
    int count = 0;
  };
  struct Row {
    std::optional<double> latest;
    Sum succeeded, failed;
  };
  std::array<Row, predict::kCriterionCount> rows_;
};

}  // namespace reachlab::gui::docks
