#pragma once
#include <QString>
#include <QVector>
#include <QWidget>
#include <memory>
#include <utility>
#include <vector>

#include "gui/plot/line_style.h"

class QCheckBox;
class QwtPlot;
class QwtPlotCurve;
class QwtPlotMarker;
class QwtPlotZoneItem;

namespace reachlab::gui::plot {

class Zoomer;

/// Of Qwt, as compiled: "6.1.4".
QString libraryVersion();

/// Velocity against time since onset [s], [m/s]. It shows hand and last mass of the trial under way, and the trial before as faint lines.
/// The window T ± dT is a band, and chosen predictions are dashed. A drag zooms in, a right click zooms back, and the pointer shows values.
/// *freeze* holds the picture, not the trial. The shown curves can be exported.
class VelocityPlot : public QWidget {
  Q_OBJECT
 public:
  explicit VelocityPlot(QWidget* parent = nullptr);
  ~VelocityPlot() override;

  void setTask(double duration, double tolerance);
  /// A new trial: the curves of the one before stay as thin lines.
  void beginTrial();
  /// Another experiment: its trials are not to be compared with those before.
  void forgetTrials();
  /// Appends a point, which the next `refresh` draws.
  void add(double time, double hand, double last);
  /// Draws the changes. Does nothing while the plot is frozen.
  void refresh();

  void setPredictions(const std::vector<PredictedLine>& lines);
  /// By the file's ending: pdf, svg, csv. False when it cannot be written.
  bool exportTo(const QString& file);
  std::size_t pointCount() const;
  std::pair<double, double> shownTimes() const;  // [s] where the time axis begins and ends now
  QSize sizeHint() const override { return {900, 260}; }
  QSize minimumSizeHint() const override { return {300, 156}; }  // [px] the title of the left axis fits

 private:
  void draw();
  void scale();

  QwtPlot* plot_;
  Zoomer* zoomer_;
  QCheckBox* freeze_;
  std::unique_ptr<QwtPlotZoneItem> band_;
  std::unique_ptr<QwtPlotMarker> goal_;
  std::unique_ptr<QwtPlotCurve> hand_, last_, handBefore_, lastBefore_;
  std::vector<std::unique_ptr<QwtPlotCurve>> predictions_;
  // The signals to draw next. The curves hold the drawn ones.
  struct Trial {
    QVector<double> times, hands, lasts;
  } now_, before_;
  std::vector<PredictedLine> lines_;
  bool newLines_ = false, newTask_ = false;
  double duration_ = 1, tolerance_ = 0.5;
  bool changed_ = false;
};

}  // namespace reachlab::gui::plot
