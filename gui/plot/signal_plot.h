#pragma once
#include <QString>
#include <QWidget>
#include <array>
#include <deque>
#include <memory>

#include "gui/widgets/qt_names.h"

class QwtPlot;
class QwtPlotCurve;

namespace reachlab::gui::plot {

class Zoomer;

/// The last seconds of one signal of the run. The signal is velocity, position or force of the hand or a mass, its phase plane, or the
/// timing of the loop. A drag zooms in, a right click zooms back, and the pointer shows values. *freeze* holds the picture. The shown
/// curves can be exported. Memory does not grow, because only the last kCapacity points are kept. SI.
class SignalPlot : public QWidget {
  Q_OBJECT
 public:
  static constexpr int kCapacity = 4096;
  enum class Quantity { Velocity, Position, Force, PhasePlane, Timing };
  struct Point {
    double time = 0;                               // [s] of the run
    std::array<double, 3> position{}, velocity{};  // of what is watched
    double force = 0;                              // [N] of the coupling
    double period = 0;                             // [ms] a tick, by the computer's clock
    double missed = 0;                             // ticks, since the point before
  };
  explicit SignalPlot(QWidget* parent = nullptr);
  ~SignalPlot() override;

  /// The hand and so many masses may be watched.
  void setMasses(int count);
  /// -1: the hand, else a mass from 0.
  int watched() const;
  Quantity quantity() const;
  void add(const Point& point);
  /// Draws the added points. Does nothing while the plot is frozen or hidden.
  void refresh();
  void clear();
  int pointCount() const;
  bool frozen() const;
  /// By the file's ending: pdf, svg, csv. False when it cannot be written.
  bool exportTo(const QString& file);
  QSize minimumSizeHint() const override { return {300, 150}; }

 Q_SIGNALS:
  void watchedChanged(int mass);

 private:
  static constexpr int kLines = 3;
  void fill();

  std::deque<Point> points_;  // the newest last
  bool changed_ = false;
  QwtPlot* plot_;
  Zoomer* zoomer_;
  std::array<std::unique_ptr<QwtPlotCurve>, kLines> curves_;
  QComboBox *quantity_, *watched_;
  QCheckBox* freeze_;
};

}  // namespace reachlab::gui::plot
