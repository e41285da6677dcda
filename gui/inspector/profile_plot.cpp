#include "gui/inspector/profile_plot.h"

#include <qwt_global.h>
#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_canvas.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_intervalcurve.h>
#include <qwt_plot_magnifier.h>
#include <qwt_plot_panner.h>
#include <qwt_scale_map.h>
#include <qwt_text.h>

#include <QMouseEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "gui/plot/plot_tools.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::inspector {
namespace {

constexpr double kNear = 7;  // pixels: what a click means

}  // namespace

struct ProfilePlot::Impl {
  QwtPlot* plot = nullptr;
  std::unique_ptr<QwtPlotIntervalCurve> band;
  std::unique_ptr<QwtPlotCurve> mean, picked;
  std::unique_ptr<QwtPlotMarker> cursor, onset, end;
  std::vector<std::unique_ptr<QwtPlotCurve>> lines, predictions;
  std::vector<Line> data;
  int pickedLine = -1;
  enum class Drag { None, Cursor, Onset, End } drag = Drag::None;
  QPoint pressedAt;
  double markAtPress = 0;
  bool moved = false;

  double xAt(int pixel) const { return plot->invTransform(QwtPlot::xBottom, pixel); }
  bool near(const QwtPlotMarker& mark, int pixel) const {
    return mark.isVisible() && std::abs(plot->transform(QwtPlot::xBottom, mark.xValue()) - pixel) < kNear;
  }
  int lineAt(const QPoint& at) const {
    const QwtScaleMap x = plot->canvasMap(QwtPlot::xBottom), y = plot->canvasMap(QwtPlot::yLeft);
    int best = -1;
    double least = kNear;
    for (std::size_t i = 0; i < data.size(); ++i)
      for (std::size_t k = 0; k + 1 < data[i].x.size(); ++k) {
        const double ax = x.transform(data[i].x[k]), ay = y.transform(data[i].y[k]);
        const double bx = x.transform(data[i].x[k + 1]) - ax, by = y.transform(data[i].y[k + 1]) - ay;
        const double length = bx * bx + by * by, px = at.x() - ax, py = at.y() - ay;
        const double part = length > 0 ? std::clamp((px * bx + py * by) / length, 0.0, 1.0) : 0;
        const double apart = std::hypot(px - part * bx, py - part * by);
        if (apart < least) least = apart, best = static_cast<int>(i);
      }
    return best;
  }
};

ProfilePlot::ProfilePlot(QWidget* parent) : QWidget(parent), impl_(std::make_unique<Impl>()) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 2, 4, 2);
  auto* plot = impl_->plot = new QwtPlot(this);
  layout->addWidget(plot);
  auto* canvas = gui::plot::dress(*plot);
  canvas->installEventFilter(this);
  canvas->setFocusPolicy(Qt::ClickFocus);  // an entry elsewhere is taken for its trial before another is picked
  gui::plot::setAxisFonts(*plot);
  plot->setAxisTitle(QwtPlot::xBottom, gui::plot::axisTitle(tr("time since onset [s]")));
  plot->setAxisTitle(QwtPlot::yLeft, gui::plot::axisTitle(tr("velocity [m/s]")));
  impl_->band = std::make_unique<QwtPlotIntervalCurve>(tr("± SD"));
  impl_->band->setBrush(widgets::ink(34));
  impl_->band->setPen(QPen(Qt::NoPen));
  impl_->band->setZ(12);
  impl_->band->attach(plot);
  impl_->picked = gui::plot::makeCurve(*plot, tr("picked"), QPen(widgets::toQColor(widgets::colours::kLast), 2.2), 40);
  impl_->mean = gui::plot::makeCurve(*plot, tr("mean"), QPen(widgets::ink(255), 2.6), 30);
  const QPen mark(widgets::toQColor(widgets::colours::kTarget), 1.6, Qt::DashLine);
  impl_->onset = gui::plot::makeMark(*plot, mark, tr("onset"), 60);
  impl_->end = gui::plot::makeMark(*plot, mark, tr("end"), 60);
  impl_->cursor = gui::plot::makeMark(*plot, QPen(widgets::ink(150), 1.6), {}, 60);
  for (const auto* of : {&impl_->onset, &impl_->end, &impl_->cursor}) (*of)->hide();
  gui::plot::addLegend(*plot);
  auto* wheel = new QwtPlotMagnifier(canvas);
  wheel->setMouseButton(Qt::NoButton);
  auto* shift = new QwtPlotPanner(canvas);
  shift->setMouseButton(Qt::MiddleButton);
  setMinimumSize(320, 180);
  setMean({});
}

ProfilePlot::~ProfilePlot() = default;

void ProfilePlot::setLines(const std::vector<Line>& lines) {
  impl_->lines.clear();
  impl_->data = lines;
  QColor thin = widgets::toQColor(widgets::colours::kDriven).lighter(125);
  thin.setAlpha(lines.size() > 40 ? 70 : lines.size() > 8 ? 120 : 190);
  for (const Line& line : lines) {
    auto curve = gui::plot::makeCurve(*impl_->plot, {}, QPen(thin, 1), 20);
    gui::plot::setSamples(*curve, line.x, line.y);
    impl_->lines.push_back(std::move(curve));
  }
  impl_->pickedLine = -1;
  setPicked(lines.size() == 1 ? 0 : -1);
  showEverything();
}

void ProfilePlot::setPicked(int line) {
  impl_->pickedLine = line >= 0 && line < lineCount() ? line : -1;
  const bool any = impl_->pickedLine >= 0;
  const Line none, &shown = any ? impl_->data[static_cast<std::size_t>(impl_->pickedLine)] : none;
  gui::plot::setSamples(*impl_->picked, shown.x, shown.y);
  impl_->picked->setItemAttribute(QwtPlotItem::Legend, any && lineCount() > 1);
  impl_->plot->replot();
}

void ProfilePlot::setMean(const Mean& of) {
  const auto& [x, mean, sd] = of;
  QVector<QwtIntervalSample> band;
  for (std::size_t i = 0; i < x.size() && i < mean.size() && i < sd.size(); ++i)
    if (std::isfinite(sd[i])) band.push_back({x[i], mean[i] - sd[i], mean[i] + sd[i]});
  impl_->band->setItemAttribute(QwtPlotItem::Legend, !band.isEmpty());
  impl_->mean->setItemAttribute(QwtPlotItem::Legend, !mean.empty());
  impl_->band->setSamples(band);
  gui::plot::setSamples(*impl_->mean, x, mean);
  impl_->plot->updateLegend();
  impl_->plot->replot();
}

void ProfilePlot::setPredictions(const std::vector<gui::plot::PredictedLine>& predictions) {
  impl_->predictions.clear();
  for (const gui::plot::PredictedLine& line : predictions) impl_->predictions.push_back(gui::plot::makePrediction(*impl_->plot, line, 50));
  impl_->plot->replot();
}

void ProfilePlot::setCursor(std::optional<double> time) {
  impl_->cursor->setVisible(time.has_value());
  if (time) impl_->cursor->setXValue(*time);
  impl_->plot->replot();
}

void ProfilePlot::setMarks(std::optional<double> onset, std::optional<double> end) {
  impl_->onset->setVisible(onset.has_value());
  impl_->end->setVisible(end.has_value());
  if (onset) impl_->onset->setXValue(*onset);
  if (end) impl_->end->setXValue(*end);
  impl_->plot->replot();
}

void ProfilePlot::showEverything() {
  for (const int axis : {int{QwtPlot::xBottom}, int{QwtPlot::yLeft}}) impl_->plot->setAxisAutoScale(axis, true);
  impl_->plot->replot();
}

int ProfilePlot::lineCount() const { return static_cast<int>(impl_->lines.size()); }
int ProfilePlot::pickedLine() const { return impl_->pickedLine; }

QPoint ProfilePlot::pixelOf(double x, double y) const {
  const QPoint at(static_cast<int>(std::lround(impl_->plot->transform(QwtPlot::xBottom, x))),
                  static_cast<int>(std::lround(impl_->plot->transform(QwtPlot::yLeft, y))));
  return impl_->plot->canvas()->mapTo(const_cast<ProfilePlot*>(this), at);
}

bool ProfilePlot::eventFilter(QObject* watched, QEvent* event) {
  Impl& d = *impl_;
  using Drag = Impl::Drag;
  if (d.plot == nullptr || watched != d.plot->canvas()) return QWidget::eventFilter(watched, event);
  const auto* mouse = static_cast<QMouseEvent*>(event);
  switch (event->type()) {
    case QEvent::MouseButtonPress:
      if (mouse->button() != Qt::LeftButton) break;
      d.pressedAt = mouse->pos();
      d.moved = false;
      d.drag = d.near(*d.onset, mouse->x()) ? Drag::Onset : d.near(*d.end, mouse->x()) ? Drag::End : Drag::Cursor;
      d.markAtPress = (d.drag == Drag::End ? *d.end : *d.onset).xValue();
      return true;
    case QEvent::MouseMove:
      if (d.drag == Drag::None) break;
      if (!d.moved && (mouse->pos() - d.pressedAt).manhattanLength() < 4) return true;
      d.moved = true;
      if (d.drag == Drag::Cursor) {
        Q_EMIT cursorMoved(d.xAt(mouse->x()));
      } else {
        (d.drag == Drag::Onset ? *d.onset : *d.end).setXValue(d.markAtPress + d.xAt(mouse->x()) - d.xAt(d.pressedAt.x()));
        d.plot->replot();
      }
      return true;
    case QEvent::MouseButtonRelease: {
      if (d.drag == Drag::None || mouse->button() != Qt::LeftButton) break;
      const Drag dragged = std::exchange(d.drag, Drag::None);
      if (d.moved && dragged != Drag::Cursor) {
        Q_EMIT marksMoved(d.onset->xValue(), d.end->xValue());
      } else if (!d.moved) {
        if (const int line = d.lineAt(mouse->pos()); line >= 0) Q_EMIT picked(line);
        else Q_EMIT cursorMoved(d.xAt(mouse->x()));
      }
      return true;
    }
    case QEvent::MouseButtonDblClick: showEverything(); return true;
    default: break;
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace reachlab::gui::inspector
