#include "gui/plot/signal_plot.h"

#include <qwt_global.h>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_curve.h>

#include <QCheckBox>
#include <QComboBox>
#include <QVector>
#include <algorithm>
#include <deque>
#include <tuple>

#include "gui/plot/plot_tools.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::plot {
namespace {

constexpr double kSpan = 10;  // [s] that are shown

QColor inkOf(int line) {
  const widgets::Colour inks[] = {widgets::colours::kDriven, widgets::colours::kLast, widgets::colours::kSurfaceLine};
  return widgets::toQColor(inks[line]).lighter(115);
}

}  // namespace

SignalPlot::SignalPlot(QWidget* parent) : QWidget(parent) {
  using widgets::named, widgets::tipped;
  quantity_ = tipped(named<QComboBox>("signalQuantity"), tr("the signal that is drawn, of the last 10 s"));
  quantity_->addItems({tr("velocity"), tr("position"), tr("force"), tr("phase plane, along x"), tr("timing")});
  watched_ = tipped(named<QComboBox>("signalWatched"), tr("the hand or the mass that is drawn"));
  freeze_ = tipped(named<QCheckBox>("signalFreeze", tr("freeze")), tr("freezes the plot. Press it again to show the current signal"));
  std::tie(plot_, zoomer_) = addPlot(this, {quantity_, watched_, freeze_}, tr("Export signal"), QStringLiteral("signal.svg"));
  for (int i = 0; i < kLines; ++i) {
    auto& curve = curves_[static_cast<std::size_t>(i)];
    curve = std::make_unique<QwtPlotCurve>();
    curve->setPen(QPen(inkOf(i), 1.6));
    curve->setRenderHint(QwtPlotItem::RenderAntialiased);
    curve->setPaintAttribute(QwtPlotCurve::ClipPolygons);
    curve->attach(plot_);
  }
  setMasses(0);
  connect(quantity_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    fill();
    zoomer_->setZoomBase(true);
  });
  connect(watched_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    clear();  // points of another body are none of this one
    Q_EMIT watchedChanged(watched());
  });
  fill();
}

SignalPlot::~SignalPlot() = default;

void SignalPlot::setMasses(int count) {
  if (watched_->count() == count + 1) return;
  const QSignalBlocker quiet(watched_);
  const int before = std::min(watched_->currentIndex(), count);
  watched_->clear();
  watched_->addItem(tr("hand"));
  for (int i = 1; i <= count; ++i) watched_->addItem(tr("mass %1").arg(i));
  watched_->setCurrentIndex(std::max(0, before));
  clear();
  Q_EMIT watchedChanged(watched());
}

int SignalPlot::watched() const { return watched_->currentIndex() - 1; }
SignalPlot::Quantity SignalPlot::quantity() const { return static_cast<Quantity>(quantity_->currentIndex()); }
int SignalPlot::pointCount() const { return static_cast<int>(points_.size()); }
bool SignalPlot::frozen() const { return freeze_->isChecked(); }

void SignalPlot::add(const Point& point) {
  if (frozen()) return;  // what is looked at is what is exported
  points_.push_back(point);
  if (pointCount() > kCapacity) points_.pop_front();
  changed_ = true;
}

void SignalPlot::clear() {
  points_.clear();
  fill();
}

void SignalPlot::refresh() {
  if (!changed_ || !isVisible() || frozen()) return;
  fill();
}

void SignalPlot::fill() {
  changed_ = false;
  const Quantity what = quantity();
  const bool three = what == Quantity::Velocity || what == Quantity::Position;
  const QString names[kLines] = {three                      ? QStringLiteral("x")
                                 : what == Quantity::Timing ? tr("period")
                                                            : watched_->currentText(),
                                 what == Quantity::Timing ? tr("missed") : QStringLiteral("y"), QStringLiteral("z")};
  const int lines = three ? 3 : what == Quantity::Timing ? 2 : 1;
  for (int line = 0; line < kLines; ++line) {
    const auto k = static_cast<std::size_t>(line);
    QVector<double> x, y;
    for (const Point& p : points_) {
      if (line >= lines || points_.back().time - p.time > kSpan) continue;
      x.push_back(what == Quantity::PhasePlane ? p.position[0] : p.time);
      switch (what) {
        case Quantity::Velocity: y.push_back(p.velocity[k]); break;
        case Quantity::Position: y.push_back(p.position[k]); break;
        case Quantity::Force: y.push_back(p.force); break;
        case Quantity::PhasePlane: y.push_back(p.velocity[0]); break;
        case Quantity::Timing: y.push_back(line == 0 ? p.period : p.missed); break;
      }
    }
    auto& curve = curves_[k];
    curve->setSamples(x, y);
    curve->setTitle(names[line]);
    curve->setItemAttribute(QwtPlotItem::Legend, line < lines);
    curve->setVisible(line < lines);
  }
  const QString units[] = {tr("velocity [m/s]"), tr("position [m]"), tr("force of the coupling [N]"), tr("velocity along x [m/s]"),
                           tr("a tick [ms], missed ticks")};
  fitLeftAxis(*plot_, units[static_cast<int>(what)]);
  plot_->setAxisTitle(QwtPlot::xBottom, axisTitle(what == Quantity::PhasePlane ? tr("position along x [m]") : tr("time of the run [s]")));
  if (zoomer_->zoomRectIndex() == 0) {
    plot_->setAxisAutoScale(QwtPlot::xBottom, true);
    plot_->setAxisAutoScale(QwtPlot::yLeft, true);
    plot_->updateAxes();
    zoomer_->setZoomBase(false);
  }
  plot_->replot();
}

bool SignalPlot::exportTo(const QString& file) {
  return exportPlot(*plot_, file, [this](QTextStream& text) {
    text << "time_s,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,coupling_force_n,tick_period_ms,missed_ticks\n";
    for (const Point& p : points_) {
      text << p.time;
      for (const auto* three : {&p.position, &p.velocity})
        for (const double value : *three) text << ',' << value;
      text << ',' << p.force << ',' << p.period << ',' << p.missed << '\n';
    }
  });
}

}  // namespace reachlab::gui::plot
