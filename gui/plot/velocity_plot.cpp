#include "gui/plot/velocity_plot.h"

#include <qwt_global.h>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_curve.h>
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

VelocityPlot::VelocityPlot(QWidget* parent) : QWidget(parent) {
  freeze_ = widgets::named<QCheckBox>("velocityFreeze", tr("freeze"));
  freeze_->setToolTip(tr("freezes the plot. Press it again to show the current trial"));
  std::tie(plot_, zoomer_) = addPlot(this, {freeze_}, tr("Export velocities"), QStringLiteral("velocity.svg"));
  plot_->setAxisTitle(QwtPlot::xBottom, axisTitle(QStringLiteral("time since onset [s]")));
  plot_->setAxisTitle(QwtPlot::yLeft, axisTitle(QStringLiteral("velocity [m/s]")));
  setAxisFonts(*plot_);
  band_ = std::make_unique<QwtPlotZoneItem>();
  band_->setOrientation(Qt::Vertical);
  const QColor green = widgets::toQColor(widgets::colours::kGreen);
  band_->setBrush(widgets::withAlpha(green, 38));
  band_->setPen(QPen(Qt::NoPen));
  band_->attach(plot_);
  goal_ = makeMark(*plot_, QPen(widgets::withAlpha(green, 150), 1, Qt::DotLine), QStringLiteral("T"), 30);

  const QColor handInk = widgets::toQColor(widgets::colours::kDriven).lighter(120), lastInk = widgets::toQColor(widgets::colours::kLast);
  handBefore_ = makeCurve(*plot_, {}, QPen(widgets::withAlpha(handInk, 110), 1), 18);
  lastBefore_ = makeCurve(*plot_, {}, QPen(widgets::withAlpha(lastInk, 110), 1), 18);
  hand_ = makeCurve(*plot_, QStringLiteral("hand"), QPen(handInk, 2.2), 22);
  last_ = makeCurve(*plot_, QStringLiteral("last mass"), QPen(lastInk, 2.2), 21);
  connect(freeze_, &QCheckBox::toggled, this, &VelocityPlot::refresh);
  draw();
}

VelocityPlot::~VelocityPlot() = default;

void VelocityPlot::draw() {
  hand_->setSamples(now_.times, now_.hands);
  last_->setSamples(now_.times, now_.lasts);
  handBefore_->setSamples(before_.times, before_.hands);
  lastBefore_->setSamples(before_.times, before_.lasts);
  band_->setInterval(std::max(0.0, duration_ - tolerance_), duration_ + tolerance_);
  goal_->setXValue(duration_);
  if (std::exchange(newLines_, false)) {
    predictions_.clear();
    for (const PredictedLine& line : lines_) predictions_.push_back(makePrediction(*plot_, line, 24));
  }
  if (std::exchange(newTask_, false)) zoomer_->zoom(0);
  if (zoomer_->zoomRectIndex() == 0) {
    scale();
    plot_->updateAxes();
    zoomer_->setZoomBase(false);
  }
  plot_->replot();
}

void VelocityPlot::scale() {
  double least = -0.02, most = 0.1;
  const auto see = [&](double v) { least = std::min(least, v), most = std::max(most, v); };
  for (const auto* curve : {hand_.get(), last_.get(), handBefore_.get(), lastBefore_.get()}) {
    const QRectF box = curve->boundingRect();
    if (box.isValid() && curve->dataSize() > 1) see(box.top()), see(box.bottom());
  }
  for (const auto& curve : predictions_) {
    const QRectF box = curve->boundingRect();
    if (box.isValid()) see(box.top()), see(box.bottom());
  }
  // Grows in steps, so that the axis does not creep while a trial runs.
  const double step = most > 0.6 ? 0.2 : 0.05;
  plot_->setAxisScale(QwtPlot::yLeft, std::floor(least * 1.04 / step) * step, std::ceil(most * 1.06 / step) * step);
  // A window in time that is open at its beginning only says how long to wait: the reach would be a splinter in it.
  const double span =
      std::max(tolerance_ < duration_ ? duration_ + tolerance_ + 0.25 : 2 * duration_, now_.times.isEmpty() ? 0.0 : now_.times.back());
  plot_->setAxisScale(QwtPlot::xBottom, 0, span);
}

void VelocityPlot::setTask(double duration, double tolerance) {
  newTask_ = newTask_ || duration != duration_ || tolerance != tolerance_;
  duration_ = duration;
  tolerance_ = tolerance;
  changed_ = true;
  refresh();
}

void VelocityPlot::beginTrial() {
  if (now_.times.size() > 1) before_ = now_;
  now_ = {};
  changed_ = true;
}

void VelocityPlot::forgetTrials() {
  beginTrial();
  before_ = {};
}

void VelocityPlot::add(double time, double hand, double last) {
  if (!std::isfinite(time) || !std::isfinite(hand) || !std::isfinite(last)) return;
  now_.times.push_back(time);
  now_.hands.push_back(hand);
  now_.lasts.push_back(last);
  changed_ = true;
}

void VelocityPlot::refresh() {
  if (!changed_ || freeze_->isChecked()) return;
  changed_ = false;
  draw();
}

void VelocityPlot::setPredictions(const std::vector<PredictedLine>& lines) {
  lines_ = lines;
  newLines_ = changed_ = true;
  refresh();
}

bool VelocityPlot::exportTo(const QString& file) {
  return exportPlot(*plot_, file, [&](QTextStream& text) {
    text << "line,time_s,velocity_m_per_s\n";
    const auto put = [&](const QString& name, const QwtPlotCurve& curve) {
      for (std::size_t i = 0; i < curve.dataSize(); ++i) {
        const QPointF p = curve.sample(static_cast<int>(i));
        text << '"' << name << "\"," << p.x() << ',' << p.y() << '\n';
      }
    };
    put(hand_->title().text(), *hand_);
    put(last_->title().text(), *last_);
    put(hand_->title().text() + tr(", trial before"), *handBefore_);
    put(last_->title().text() + tr(", trial before"), *lastBefore_);
    for (const auto& prediction : predictions_) put(prediction->title().text(), *prediction);
  });
}

std::pair<double, double> VelocityPlot::shownTimes() const {
  const QwtInterval shown = plot_->axisInterval(QwtPlot::xBottom);
  return {shown.minValue(), shown.maxValue()};
}

std::size_t VelocityPlot::pointCount() const { return static_cast<std::size_t>(now_.times.size()); }

}  // namespace reachlab::gui::plot
