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
constexpr int kLines = 3;

QColor inkOf(int line) {
  const widgets::Colour inks[kLines] = {widgets::colours::kDriven, widgets::colours::kLast, widgets::colours::kSurfaceLine};
  return widgets::toQColor(inks[line]).lighter(115);
}

}  // namespace

struct SignalPlot::Impl {
  std::deque<Point> points;  // the newest last
  bool changed = false;
  QwtPlot* plot = nullptr;
  std::array<std::unique_ptr<QwtPlotCurve>, kLines> curves;
  Zoomer* zoomer = nullptr;
  QComboBox *quantity = nullptr, *watched = nullptr;
  QCheckBox* freeze = nullptr;
};

SignalPlot::SignalPlot(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
  Impl& d = *impl_;
  d.quantity = widgets::named<QComboBox>("signalQuantity");
  d.quantity->addItems({tr("velocity"), tr("position"), tr("force"), tr("phase plane, along x"), tr("timing")});
  d.watched = widgets::named<QComboBox>("signalWatched");
  d.freeze = widgets::named<QCheckBox>("signalFreeze", tr("freeze"));
  d.quantity->setToolTip(tr("the signal that is drawn, of the last 10 s"));
  d.watched->setToolTip(tr("the hand or the mass that is drawn"));
  d.freeze->setToolTip(tr("freezes the plot. Press it again to show the current signal"));
  std::tie(d.plot, d.zoomer) = addPlot(this, {d.quantity, d.watched, d.freeze}, tr("Export signal"), QStringLiteral("signal.svg"));
  for (int i = 0; i < kLines; ++i) {
    auto& curve = d.curves[static_cast<std::size_t>(i)];
    curve = std::make_unique<QwtPlotCurve>();
    curve->setPen(QPen(inkOf(i), 1.6));
    curve->setRenderHint(QwtPlotItem::RenderAntialiased);
    curve->setPaintAttribute(QwtPlotCurve::ClipPolygons);
    curve->attach(d.plot);
  }
  setMasses(0);
  connect(d.quantity, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    fill();
    impl_->zoomer->setZoomBase(true);
  });
  connect(d.watched, qOverload<int>(&QComboBox::currentIndexChanged), this, [this] {
    clear();  // points of another body are none of this one
    Q_EMIT watchedChanged(watched());
  });
  fill();
}

SignalPlot::~SignalPlot() = default;

void SignalPlot::setMasses(int count) {
  if (impl_->watched->count() == count + 1) return;
  const QSignalBlocker quiet(impl_->watched);
  const int before = std::min(impl_->watched->currentIndex(), count);
  impl_->watched->clear();
  impl_->watched->addItem(tr("hand"));
  for (int i = 1; i <= count; ++i) impl_->watched->addItem(tr("mass %1").arg(i));
  impl_->watched->setCurrentIndex(std::max(0, before));
  clear();
}

int SignalPlot::watched() const { return impl_->watched->currentIndex() - 1; }
SignalPlot::Quantity SignalPlot::quantity() const { return static_cast<Quantity>(impl_->quantity->currentIndex()); }
int SignalPlot::pointCount() const { return static_cast<int>(impl_->points.size()); }
bool SignalPlot::frozen() const { return impl_->freeze->isChecked(); }

void SignalPlot::add(const Point& point) {
  if (frozen()) return;  // what is looked at is what is exported
  impl_->points.push_back(point);
  if (pointCount() > kCapacity) impl_->points.pop_front();
  impl_->changed = true;
}

void SignalPlot::clear() {
  impl_->points.clear();
  fill();
}

void SignalPlot::refresh() {
  if (!impl_->changed || !isVisible() || frozen()) return;
  fill();
}

void SignalPlot::fill() {
  Impl& d = *impl_;
  d.changed = false;
  const Quantity what = quantity();
  const bool three = what == Quantity::Velocity || what == Quantity::Position;
  const QString names[kLines] = {three                      ? QStringLiteral("x")
                                 : what == Quantity::Timing ? tr("period")
                                                            : d.watched->currentText(),
                                 what == Quantity::Timing ? tr("missed") : QStringLiteral("y"), QStringLiteral("z")};
  const int lines = three ? 3 : what == Quantity::Timing ? 2 : 1;
  for (int line = 0; line < kLines; ++line) {
    const auto k = static_cast<std::size_t>(line);
    QVector<double> x, y;
    for (const Point& p : d.points) {
      if (line >= lines || d.points.back().time - p.time > kSpan) continue;
      x.push_back(what == Quantity::PhasePlane ? p.position[0] : p.time);
      switch (what) {
        case Quantity::Velocity: y.push_back(p.velocity[k]); break;
        case Quantity::Position: y.push_back(p.position[k]); break;
        case Quantity::Force: y.push_back(p.force); break;
        case Quantity::PhasePlane: y.push_back(p.velocity[0]); break;
        case Quantity::Timing: y.push_back(line == 0 ? p.period : p.missed); break;
      }
    }
    auto& curve = d.curves[k];
    curve->setSamples(x, y);
    curve->setTitle(names[line]);
    curve->setItemAttribute(QwtPlotItem::Legend, line < lines);
    curve->setVisible(line < lines);
  }
  const QString units[] = {tr("velocity [m/s]"), tr("position [m]"), tr("force of the coupling [N]"), tr("velocity along x [m/s]"),
                           tr("a tick [ms], missed ticks")};
  d.plot->setAxisTitle(QwtPlot::yLeft, axisTitle(units[static_cast<int>(what)]));
  d.plot->setAxisTitle(QwtPlot::xBottom, axisTitle(what == Quantity::PhasePlane ? tr("position along x [m]") : tr("time of the run [s]")));
  if (d.zoomer->zoomRectIndex() == 0) {
    d.plot->setAxisAutoScale(QwtPlot::xBottom, true);
    d.plot->setAxisAutoScale(QwtPlot::yLeft, true);
    d.plot->updateAxes();
    d.zoomer->setZoomBase(false);
  }
  d.plot->replot();
}

bool SignalPlot::exportTo(const QString& file) {
  return exportPlot(*impl_->plot, file, [this](QTextStream& text) {
    text << "time_s,x_m,y_m,z_m,vx_m_per_s,vy_m_per_s,vz_m_per_s,coupling_force_n,tick_period_ms,missed_ticks\n";
    for (const Point& p : impl_->points) {
      text << p.time;
      for (const auto* three : {&p.position, &p.velocity})
        for (const double value : *three) text << ',' << value;
      text << ',' << p.force << ',' << p.period << ',' << p.missed << '\n';
    }
  });
}

}  // namespace reachlab::gui::plot
