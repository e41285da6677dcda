#include "gui/choosers/device_view.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/widgets/theme.h"

namespace reachlab::gui::docks {
namespace {

using widgets::toQColor;
namespace colours = widgets::colours;

constexpr double kTitleHeight = 18, kGap = 12;

}  // namespace

DeviceView::DeviceView(QWidget* parent) : QWidget(parent) { setMinimumHeight(190); }

void DeviceView::display(const devices::LiveDevice::View& view, double reach, double force) {
  view_ = view;
  reach_ = reach;
  force_ = force;
  live_ = true;
  update();
}

void DeviceView::clear() {
  live_ = false;
  update();
}

void DeviceView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double side = std::min<double>(height(), (width() - 2 * kGap) / 3.2);
  drawPlace(painter, {0, 0, side, side}, tr("from the front"), view_.position.x, view_.position.y, view_.force.x, view_.force.y);
  drawPlace(painter, {side + kGap, 0, side, side}, tr("from above"), view_.position.x, -view_.position.z, view_.force.x, -view_.force.z);
  drawIntervals(painter, {2 * (side + kGap), 0, width() - 2 * (side + kGap), side});
}

void DeviceView::drawPlace(QPainter& painter, const QRectF& frame, const QString& title, double right, double up, double forceRight,
                           double forceUp) const {
  painter.setPen(toQColor(colours::kFaintText));
  painter.drawText(QRectF(frame.left(), frame.top(), frame.width(), kTitleHeight),
                   title + QStringLiteral(", ± %1 mm").arg(1e3 * reach_, 0, 'f', 0));
  const QRectF field = frame.adjusted(0, kTitleHeight, 0, 0);
  painter.fillRect(field, toQColor(colours::kBase));
  const double scale = std::min(field.width(), field.height()) / 2 / (1.1 * reach_);
  const QPointF middle = field.center();
  painter.setPen(QPen(toQColor(colours::kNeutral), 1));
  painter.drawLine(QPointF(field.left(), middle.y()), QPointF(field.right(), middle.y()));
  painter.drawLine(QPointF(middle.x(), field.top()), QPointF(middle.x(), field.bottom()));
  painter.drawEllipse(middle, reach_ * scale, reach_ * scale);
  if (!live_) return;
  painter.setClipRect(field);
  const QPointF place = middle + scale * QPointF(right, -up);
  const QPointF at(std::clamp(place.x(), field.left(), field.right()), std::clamp(place.y(), field.top(), field.bottom()));
  const QPointF tip = at + field.width() / 2 / force_ * QPointF(forceRight, -forceUp);
  painter.setPen(QPen(toQColor(colours::kLast), 3));
  painter.drawLine(at, tip);
  painter.setPen(Qt::NoPen);
  painter.setBrush(toQColor(view_.valid ? colours::kHand : colours::kHandLost));
  painter.drawEllipse(at, 6, 6);
  painter.setBrush(Qt::NoBrush);
  painter.setClipping(false);
}

void DeviceView::drawIntervals(QPainter& painter, const QRectF& frame) const {
  constexpr double kScaleHeight = 18;
  painter.setPen(toQColor(colours::kFaintText));
  painter.drawText(QRectF(frame.left(), frame.top(), frame.width(), kTitleHeight), tr("time between reports"));
  const QRectF field = frame.adjusted(0, kTitleHeight, 0, -kScaleHeight);
  painter.fillRect(field, toQColor(colours::kBase));
  const auto& bins = view_.between;
  const double width = field.width() / static_cast<double>(bins.size());
  // By the logarithm: the few that come late are what is looked for.
  const double most = std::log1p(static_cast<double>(*std::max_element(bins.begin(), bins.end())));
  for (std::size_t i = 0; live_ && most > 0 && i < bins.size(); ++i) {
    const double height = field.height() * std::log1p(static_cast<double>(bins[i])) / most;
    painter.fillRect(QRectF(field.left() + static_cast<double>(i) * width, field.bottom() - height, std::max(1.0, width - 1), height),
                     toQColor(colours::kAccent));
  }
  const double longest = 1e3 * devices::LiveDevice::kBinSeconds * static_cast<double>(bins.size());
  painter.setPen(toQColor(colours::kFaintText));
  for (int ms = 0; ms <= static_cast<int>(longest); ms += 2) {
    const double x = field.left() + field.width() * ms / longest;
    const bool last = ms + 2 > static_cast<int>(longest);
    painter.drawText(QRectF(last ? x - 60 : x, field.bottom() + 2, 60, kScaleHeight), last ? Qt::AlignRight : Qt::AlignLeft,
                     last ? QStringLiteral("≥ %1 ms").arg(ms) : QString::number(ms));
  }
}

}  // namespace reachlab::gui::docks
