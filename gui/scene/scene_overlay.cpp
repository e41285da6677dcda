#include "gui/scene/scene_overlay.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/widgets/theme.h"

namespace reachlab::gui::scene {
namespace {

constexpr int kWrapped = Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap;

QString lengthText(double metres) {
  if (metres >= 1) return QStringLiteral("%1 m").arg(metres);
  if (metres >= 0.01) return QStringLiteral("%1 cm").arg(std::round(metres * 100));
  return QStringLiteral("%1 mm").arg(metres * 1000);
}

void write(QPainter& painter, const QRectF& where, int flags, const QString& words, double points, const QColor& ink,
           int weight = QFont::Normal) {
  QFont font = painter.font();
  font.setPointSizeF(points);
  font.setWeight(weight);
  painter.setFont(font);
  painter.setPen(ink);
  painter.drawText(where, flags, words);
}

}  // namespace

double roundLength(double most) {
  if (!(most > 0) || !std::isfinite(most)) return 0;
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  const double share = most / decade;
  return (share >= 5 ? 5 : share >= 2 ? 2 : 1) * decade;
}

double pointsToFit(const QString& text, QFont font, double most, const QSizeF& room) {
  constexpr double kLeast = 1;
  double points = most;  // hinted widths do not grow as sizes do: tried, not computed
  for (; points > kLeast; points *= 0.97) {
    font.setPointSizeF(points);
    const QRectF needed = QFontMetricsF(font).boundingRect(QRectF(0, 0, room.width(), 1e6), kWrapped, text);
    if (needed.width() <= room.width() && needed.height() <= room.height()) break;
  }
  return points;
}

SceneOverlay::SceneOverlay(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setAttribute(Qt::WA_NoSystemBackground);
}

void SceneOverlay::setState(const OverlayState& state) {
  if (state == state_) return;
  state_ = state;
  update();
}

void SceneOverlay::setView(const std::array<QPointF, 3>& axes, double metresPerPixel) {
  if (axes == axes_ && metresPerPixel == metresPerPixel_) return;
  axes_ = axes;
  metresPerPixel_ = metresPerPixel;
  update();
}

void SceneOverlay::setTextScale(double scale) {
  textScale_ = scale;
  update();
}

void SceneOverlay::setLabel(const QString& text, const QPointF& at) {
  if (text == label_ && (text.isEmpty() || at == labelAt_)) return;
  label_ = text;
  labelAt_ = at;
  update();
}

namespace {

// Told by its sign as well as by its colour: empty before the time, a tick inside it, a cross after it.
void paintLamp(QPainter& painter, trial::Semaphore semaphore, const QRectF& square, double s) {
  using namespace widgets::colours;
  const bool lit = semaphore != trial::Semaphore::Neutral, green = semaphore == trial::Semaphore::Green;
  const QColor lamp = widgets::toQColor(!lit ? kLampNeutral : green ? kLampGreen : kLampRed);
  painter.setPen(QPen(lamp, 4 * s));
  painter.setBrush(lit ? QBrush(lamp) : QBrush(Qt::NoBrush));
  painter.drawRoundedRect(square.adjusted(2 * s, 2 * s, -2 * s, -2 * s), 6 * s, 6 * s);
  const auto at = [&](double x, double y) { return square.topLeft() + QPointF(x * square.width(), y * square.height()); };
  const QColor ink = semaphore == trial::Semaphore::Red ? QColor(Qt::white) : widgets::toQColor(widgets::colours::kBase);
  painter.setPen(QPen(ink, 6 * s, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  if (green) painter.drawPolyline(QPolygonF(QVector<QPointF>{at(0.26, 0.54), at(0.44, 0.71), at(0.75, 0.31)}));
  if (semaphore == trial::Semaphore::Red) {
    painter.drawLine(at(0.30, 0.30), at(0.70, 0.70));
    painter.drawLine(at(0.70, 0.30), at(0.30, 0.70));
  }
}

}  // namespace

void SceneOverlay::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double s = textScale_;
  const QRectF square(20 * s, 18 * s, 58 * s, 58 * s);
  double left = 20 * s;
  if (state_.semaphoreShown) {
    paintLamp(painter, state_.semaphore, square, s);
    left = square.right() + 18 * s;
  }
  const QColor faint = widgets::toQColor(widgets::colours::kFaintText);
  constexpr int kOneLine = Qt::AlignLeft | Qt::AlignVCenter;
  const double room = width() - left - 12;
  write(painter, QRectF(left, 14 * s, room, 20 * s), kOneLine, state_.counter, 10.5 * s, faint);
  QFont font = painter.font();
  font.setWeight(QFont::DemiBold);
  const widgets::Colour tone = state_.tone == OverlayState::Tone::Good  ? widgets::colours::kGreen
                               : state_.tone == OverlayState::Tone::Bad ? widgets::colours::kBadText
                                                                        : widgets::colours::kText;
  const QRectF line(left, 33 * s, room, 32 * s);  // why a trial failed is to be read to its end, in two lines where one is too small
  write(painter, line, kOneLine | Qt::TextWordWrap, state_.instruction, pointsToFit(state_.instruction, font, 19 * s, line.size()),
        widgets::toQColor(tone), QFont::DemiBold);
  write(painter, QRectF(left, 65 * s, room, 22 * s), kOneLine, state_.detail, 11 * s, faint);
  if (!state_.task.isEmpty()) {
    const QRectF place(left, 97 * s, std::min(room, 560 * s), std::max(1.0, height() - 97 * s - state_.below));
    font = painter.font();
    font.setPointSizeF(pointsToFit(state_.task, font, 11 * s, place.size()));
    painter.setFont(font);
    QColor shade = widgets::toQColor(widgets::colours::kWindow);
    shade.setAlphaF(0.72);  // to be read over whatever is drawn behind
    painter.fillRect(painter.boundingRect(place, kWrapped, state_.task).adjusted(-5 * s, -3 * s, 5 * s, 3 * s), shade);
    painter.setPen(widgets::toQColor(widgets::colours::kText));
    painter.drawText(place, kWrapped, state_.task);
  }
  if (state_.rest) paintRest(painter, *state_.rest);
  if (!state_.rulersShown) return;
  paintScale(painter);
  paintAxes(painter);
  // Between axes and scale.
  write(painter, QRectF(100, height() - kFootHeight - 14, 0.76 * width() - 140, kFootHeight),
        Qt::AlignLeft | Qt::AlignBottom | Qt::TextWordWrap, state_.legend, 9.5, faint);
  if (!label_.isEmpty()) paintLabel(painter);
}

// Title, time left, a bar of the blocks, and what the next block asks for.
void SceneOverlay::paintRest(QPainter& painter, const RestState& rest) const {
  constexpr int kWords = Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap;
  const QString time = rest.secondsLeft <= 0
                           ? QString()
                           : QStringLiteral("%1:%2").arg(rest.secondsLeft / 60).arg(rest.secondsLeft % 60, 2, 10, QLatin1Char('0'));
  struct Text {
    QString words;
    double points;
    int weight;
  };
  double s = textScale_;
  const double wide = std::min(560 * s, width() - 40.0);
  const auto texts = [&] {
    return std::array<Text, 3>{
        {{rest.title, 15 * s, QFont::DemiBold}, {time, 54 * s, QFont::Light}, {rest.instructions, 14 * s, QFont::Normal}}};
  };
  const auto inside = [&] { return wide - 44 * s; };
  const auto heightOf = [&](const Text& text) {
    QFont font = painter.font();
    font.setPointSizeF(text.points);
    font.setWeight(text.weight);
    const QRectF room(0, 0, inside(), 1e6);
    return text.words.isEmpty() ? 0.0 : QFontMetricsF(font).boundingRect(room, kWords, text.words).height() + 12 * s;
  };
  const auto high = [&] {
    double sum = (44 + 8 + 16) * s;
    for (const Text& text : texts()) sum += heightOf(text);
    return sum;
  };
  while (s > 0.1 && headHeight() + high() > height() - 12) s *= 0.97;  // instructions are to be read to their end
  const auto [title, clock, instructions] = texts();
  const double pad = 22 * s, bar = 8 * s;
  const QRectF panel((width() - wide) / 2, std::max(headHeight(), (height() - high()) / 2), wide, high());
  QColor shade = widgets::toQColor(widgets::colours::kBase);
  shade.setAlphaF(0.88);
  painter.setPen(Qt::NoPen);
  painter.setBrush(shade);
  painter.drawRoundedRect(panel, 10 * s, 10 * s);
  double y = panel.top() + pad;
  const auto put = [&](const Text& text) {
    write(painter, QRectF(panel.left() + pad, y, inside(), panel.bottom() - y), kWords, text.words, text.points,
          widgets::toQColor(widgets::colours::kText), text.weight);
    y += heightOf(text);
  };
  put(title);
  put(clock);
  const QRectF track(panel.left() + pad, y, inside(), bar);
  painter.setPen(Qt::NoPen);
  painter.setBrush(widgets::toQColor(widgets::colours::kButton));
  painter.drawRoundedRect(track, bar / 2, bar / 2);
  painter.setBrush(widgets::toQColor(widgets::colours::kAccent));
  if (rest.blocks > 0 && rest.blocksDone > 0)
    painter.drawRoundedRect(QRectF(track.topLeft(), QSizeF(std::max(bar, inside() * rest.blocksDone / rest.blocks), bar)), bar / 2,
                            bar / 2);
  y += bar + 16 * s;
  put(instructions);
}

// Below what it speaks of, at the end of a short line.
void SceneOverlay::paintLabel(QPainter& painter) const {
  const double s = textScale_;
  const QPointF end = labelAt_ + QPointF(0, 26 * s);
  painter.setPen(QPen(widgets::toQColor(widgets::colours::kFaintText), 1.2 * s));
  painter.drawLine(labelAt_, end);
  write(painter, QRectF(end.x() - 100 * s, end.y(), 200 * s, 22 * s), Qt::AlignHCenter | Qt::AlignTop, label_, 11 * s,
        widgets::toQColor(widgets::colours::kText));
}

void SceneOverlay::paintScale(QPainter& painter) const {
  const double length = roundLength(0.22 * width() * metresPerPixel_);
  if (length <= 0) return;
  const double pixels = length / metresPerPixel_, right = width() - 22, y = height() - 22;
  const QColor faint = widgets::toQColor(widgets::colours::kFaintText);
  painter.setPen(QPen(faint, 1.6));
  painter.drawLine(QPointF(right - pixels, y), QPointF(right, y));
  for (const double end : {right - pixels, right}) painter.drawLine(QPointF(end, y - 5), QPointF(end, y + 5));
  write(painter, QRectF(right - pixels, y - 24, pixels, 18), Qt::AlignCenter, lengthText(length), 9.5, faint);
}

void SceneOverlay::paintAxes(QPainter& painter) const {
  const QPointF origin(46, height() - 44);
  const double arm = 26;
  const std::array<QColor, 3> ink{QColor(235, 110, 100), QColor(120, 210, 120), QColor(110, 165, 250)};
  const std::array<QString, 3> names{QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};
  for (std::size_t i = 0; i < 3; ++i) {
    painter.setPen(QPen(ink[i], 2));
    painter.drawLine(origin, origin + arm * axes_[i]);
    write(painter, QRectF(origin + 1.36 * arm * axes_[i] - QPointF(8, 8), QSizeF(16, 16)), Qt::AlignCenter, names[i], 9, ink[i]);
  }
}

}  // namespace reachlab::gui::scene
