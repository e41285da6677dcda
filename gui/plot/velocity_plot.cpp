#include "gui/plot/velocity_plot.h"

#include <qwt_global.h>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_marker.h>
#include <qwt_plot_zoneitem.h>
#include <qwt_scale_widget.h>

#include <QCheckBox>
#include <QVector>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "gui/plot/plot_tools.h"
#include "gui/widgets/named.h"

namespace reachlab::gui::plot {

QString libraryVersion() { return QStringLiteral(QWT_VERSION_STR); }

struct VelocityPlot::Impl {
  QwtPlot* plot = nullptr;
  std::unique_ptr<QwtPlotZoneItem> band;
  std::unique_ptr<QwtPlotMarker> goal;
  std::unique_ptr<QwtPlotCurve> hand, last, handBefore, lastBefore;
  std::vector<std::unique_ptr<QwtPlotCurve>> predictions;
  Zoomer* zoomer = nullptr;
  QCheckBox* freeze = nullptr;
  struct Trial {
    QVector<double> times, hands, lasts;
  };
  // What is to be drawn next; the curves hold what is drawn.
  Trial now, before;
  std::vector<PredictedLine> lines;
  bool newLines = false, newTask = false;
  double duration = 1, tolerance = 0.5;
  bool changed = false;

  void draw() {
    hand->setSamples(now.times, now.hands);
    last->setSamples(now.times, now.lasts);
    handBefore->setSamples(before.times, before.hands);
    lastBefore->setSamples(before.times, before.lasts);
    band->setInterval(std::max(0.0, duration - tolerance), duration + tolerance);
    goal->setXValue(duration);
    if (std::exchange(newLines, false)) {
      predictions.clear();
      for (const PredictedLine& line : lines) predictions.push_back(makePrediction(*plot, line, 24));
    }
    if (std::exchange(newTask, false)) zoomer->zoom(0);
    if (zoomer->zoomRectIndex() == 0) {
      scale();
      plot->updateAxes();
      zoomer->setZoomBase(false);
    }
    plot->replot();
  }

  void scale() {
    double least = -0.02, most = 0.1;
    const auto see = [&](double v) { least = std::min(least, v), most = std::max(most, v); };
    for (const auto* curve : {hand.get(), last.get(), handBefore.get(), lastBefore.get()}) {
      const QRectF box = curve->boundingRect();
      if (box.isValid() && curve->dataSize() > 1) see(box.top()), see(box.bottom());
    }
    for (const auto& curve : predictions) {
      const QRectF box = curve->boundingRect();
      if (box.isValid()) see(box.top()), see(box.bottom());
    }
    // Grows in steps, so that the axis does not creep while a trial runs.
    const double step = most > 0.6 ? 0.2 : 0.05;
    plot->setAxisScale(QwtPlot::yLeft, std::floor(least * 1.04 / step) * step, std::ceil(most * 1.06 / step) * step);
    // A window in time that is open at its beginning only says how long to wait: the reach would be a splinter in it.
    const double span =
        std::max(tolerance < duration ? duration + tolerance + 0.25 : 2 * duration, now.times.isEmpty() ? 0.0 : now.times.back());
    plot->setAxisScale(QwtPlot::xBottom, 0, span);
  }
};

VelocityPlot::VelocityPlot(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
  impl_->freeze = widgets::named<QCheckBox>("velocityFreeze", tr("freeze"));
  impl_->freeze->setToolTip(tr("freezes the plot. Press it again to show the current trial"));
  std::tie(impl_->plot, impl_->zoomer) = addPlot(this, {impl_->freeze}, tr("Export velocities"), QStringLiteral("velocity.svg"));
  QwtPlot* plot = impl_->plot;
  plot->setAxisTitle(QwtPlot::xBottom, axisTitle(QStringLiteral("time since onset [s]")));
  plot->setAxisTitle(QwtPlot::yLeft, axisTitle(QStringLiteral("velocity [m/s]")));
  setAxisFonts(*plot);
  impl_->band = std::make_unique<QwtPlotZoneItem>();
  impl_->band->setOrientation(Qt::Vertical);
  QColor green = widgets::toQColor(widgets::colours::kGreen);
  green.setAlpha(38);
  impl_->band->setBrush(green);
  impl_->band->setPen(QPen(Qt::NoPen));
  impl_->band->attach(plot);
  impl_->goal = std::make_unique<QwtPlotMarker>();
  impl_->goal->setLineStyle(QwtPlotMarker::VLine);
  green.setAlpha(150);
  impl_->goal->setLinePen(QPen(green, 1, Qt::DotLine));
  QwtText label(QStringLiteral("T"));
  label.setColor(green);
  impl_->goal->setLabel(label);
  impl_->goal->setLabelAlignment(Qt::AlignRight | Qt::AlignTop);
  impl_->goal->attach(plot);

  const QColor handInk = widgets::toQColor(widgets::colours::kDriven).lighter(120), lastInk = widgets::toQColor(widgets::colours::kLast);
  QColor handFaint = handInk, lastFaint = lastInk;
  handFaint.setAlpha(110);
  lastFaint.setAlpha(110);
  impl_->handBefore = makeCurve(*plot, {}, QPen(handFaint, 1), 18);
  impl_->lastBefore = makeCurve(*plot, {}, QPen(lastFaint, 1), 18);
  impl_->hand = makeCurve(*plot, QStringLiteral("hand"), QPen(handInk, 2.2), 22);
  impl_->last = makeCurve(*plot, QStringLiteral("last mass"), QPen(lastInk, 2.2), 21);
  connect(impl_->freeze, &QCheckBox::toggled, this, &VelocityPlot::refresh);
  impl_->draw();
}

VelocityPlot::~VelocityPlot() = default;

void VelocityPlot::setTask(double duration, double tolerance) {
  Impl& d = *impl_;
  d.newTask = d.newTask || duration != d.duration || tolerance != d.tolerance;
  d.duration = duration;
  d.tolerance = tolerance;
  d.changed = true;
  refresh();
}

void VelocityPlot::beginTrial() {
  Impl& d = *impl_;
  if (d.now.times.size() > 1) d.before = d.now;
  d.now = {};
  d.changed = true;
}

void VelocityPlot::forgetTrials() {
  beginTrial();
  impl_->before = {};
}

void VelocityPlot::add(double time, double hand, double last) {
  if (!std::isfinite(time) || !std::isfinite(hand) || !std::isfinite(last)) return;
  Impl::Trial& now = impl_->now;
  now.times.push_back(time);
  now.hands.push_back(hand);
  now.lasts.push_back(last);
  impl_->changed = true;
}

void VelocityPlot::refresh() {
  Impl& d = *impl_;
  if (!d.changed || d.freeze->isChecked()) return;
  d.changed = false;
  d.draw();
}

void VelocityPlot::setPredictions(const std::vector<PredictedLine>& lines) {
  impl_->lines = lines;
  impl_->newLines = impl_->changed = true;
  refresh();
}

bool VelocityPlot::exportTo(const QString& file) {
  Impl& d = *impl_;
  return exportPlot(*d.plot, file, [&](QTextStream& text) {
    text << "line,time_s,velocity_m_per_s\n";
    const auto put = [&](const QString& name, const QwtPlotCurve& curve) {
      for (std::size_t i = 0; i < curve.dataSize(); ++i) {
        const QPointF p = curve.sample(static_cast<int>(i));
        text << '"' << name << "\"," << p.x() << ',' << p.y() << '\n';
      }
    };
    put(d.hand->title().text(), *d.hand);
    put(d.last->title().text(), *d.last);
    put(d.hand->title().text() + tr(", trial before"), *d.handBefore);
    put(d.last->title().text() + tr(", trial before"), *d.lastBefore);
    for (const auto& prediction : d.predictions) put(prediction->title().text(), *prediction);
  });
}

std::pair<double, double> VelocityPlot::shownTimes() const {
  const QwtInterval shown = impl_->plot->axisInterval(QwtPlot::xBottom);
  return {shown.minValue(), shown.maxValue()};
}

std::size_t VelocityPlot::pointCount() const { return static_cast<std::size_t>(impl_->now.times.size()); }

}  // namespace reachlab::gui::plot
