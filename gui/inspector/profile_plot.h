#pragma once
#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "gui/plot/line_style.h"

namespace reachlab::gui::inspector {

/// Velocities of many trials, their mean and scatter, and predictions. A click on a line picks its trial, and a drag moves the time cursor.
/// A drag on a dashed mark moves onset or end of the picked trial. The wheel zooms, the middle button shifts, a double click shows
/// everything. [s], [m/s]
class ProfilePlot : public QWidget {
  Q_OBJECT
 public:
  explicit ProfilePlot(QWidget* parent = nullptr);
  ~ProfilePlot() override;

  struct Line {
    std::vector<double> x, y;
  };
  /// Of several lines, with their scatter. Empty: none.
  struct Mean {
    std::vector<double> x, mean, sd;
  };
  void setLines(const std::vector<Line>& lines);
  /// Picks a line by its index, or -1 for no line.
  void setPicked(int line);
  void setMean(const Mean& mean);
  void setPredictions(const std::vector<gui::plot::PredictedLine>& predictions);
  void setCursor(std::optional<double> time);
  void setMarks(std::optional<double> onset, std::optional<double> end);
  void showEverything();

  int lineCount() const;
  int pickedLine() const;
  /// Where a point is in this widget. For tests that drive it.
  QPoint pixelOf(double x, double y) const;

 Q_SIGNALS:
  void picked(int line);
  void cursorMoved(double time);
  /// A mark was dragged and let go.
  void marksMoved(double onset, double end);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace reachlab::gui::inspector
