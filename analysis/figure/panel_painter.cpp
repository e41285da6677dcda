#include "analysis/figure/panel_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reachlab::figure {
namespace {

constexpr double kTickFont = 7, kLabelFont = 8, kTitleFont = 8.5, kLegendFont = 7;  // [pt]
constexpr double kTickLength = 3, kGap = 3;                                         // [pt]
constexpr double kEdge = 1;                                                         // [pt] that a line on the border may reach beyond it
constexpr double kSample = 20, kLegendLine = 10.5, kLegendPad = 4;                  // [pt] of the legend
constexpr Color kInk{0.15, 0.15, 0.15};

struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(const std::vector<double>& values, Scale scale) {
    for (const double v : values)
      if (std::isfinite(v) && (scale == Scale::Linear || v > 0)) low = std::min(low, v), high = std::max(high, v);
  }
  /// Room for a marker at either end.
  void pad(Scale scale) {
    if (!(high > low)) return;
    const double part = 0.04;
    const double factor = scale == Scale::Log ? std::pow(high / low, part) : 1, add = scale == Scale::Log ? 0 : part * (high - low);
    low = low / factor - add;
    high = high * factor + add;
  }
};

bool isRight(LegendPlace place) { return place == LegendPlace::TopRight || place == LegendPlace::BottomRight; }
bool isBottom(LegendPlace place) { return place == LegendPlace::BottomLeft || place == LegendPlace::BottomRight; }

double share(const Axis& axis, const AxisTicks& ticks, double value) {
  return axis.scale == Scale::Log ? std::log(value / ticks.from) / std::log(ticks.to / ticks.from)
                                  : (value - ticks.from) / (ticks.to - ticks.from);
}

}  // namespace

PanelPainter::PanelPainter(Canvas& canvas, const Panel& panel, double width, double height)
    : canvas_(canvas), panel_(panel), width_(width), height_(height) {
  chooseRanges();
  chooseLegend();
  measure();
}

double PanelPainter::xAt(double value) const { return width_ * share(panel_.x, x_, value); }
double PanelPainter::yAt(double value) const { return height_ * (1 - share(panel_.y, y_, value)); }

void PanelPainter::chooseRanges() {
  Extent x, y;
  for (const Series& s : panel_.series) {
    x.include(s.x, panel_.x.scale);
    for (const auto* values : {&s.y, &s.errorLow, &s.errorHigh}) y.include(*values, panel_.y.scale);
  }
  for (const Band& b : panel_.bands) {
    x.include(b.x, panel_.x.scale);
    y.include(b.low, panel_.y.scale);
    y.include(b.high, panel_.y.scale);
  }
  for (const Rule& r : panel_.rules) (r.vertical ? x : y).include({r.at}, (r.vertical ? panel_.x : panel_.y).scale);
  const bool markers =
      std::any_of(panel_.series.begin(), panel_.series.end(), [](const Series& s) { return s.marker != MarkerShape::None; });
  if (markers) x.pad(panel_.x.scale), y.pad(panel_.y.scale);
  x_ = chooseTicks(panel_.x, x.low, x.high, width_);
  y_ = chooseTicks(panel_.y, y.low, y.high, height_);
}

void PanelPainter::chooseLegend() {
  for (const Band& band : panel_.bands)
    if (!band.label.empty()) entries_.push_back({nullptr, &band});
  for (const Series& series : panel_.series)
    if (!series.label.empty()) entries_.push_back({&series, nullptr});
  place_ = entries_.empty() ? LegendPlace::None : panel_.legend;
  if (place_ == LegendPlace::None) return;

  canvas_.setFont(kLegendFont);
  double widest = 0;
  for (const Entry& entry : entries_) widest = std::max(widest, canvas_.textWidth(entry.label()));
  const double column = kSample + kGap + widest;
  const auto shape = [&](int columns) {
    legendColumns_ = columns;
    legendWidth_ = columns * column + (columns - 1) * 8 + 2 * kLegendPad;
    const int rows = (static_cast<int>(entries_.size()) + columns - 1) / columns;
    legendHeight_ = rows * kLegendLine + 2 * kLegendPad - 2;
  };
  shape(1);
  if (place_ == LegendPlace::Auto) {
    int fewest = std::numeric_limits<int>::max();
    for (const LegendPlace corner : {LegendPlace::TopRight, LegendPlace::TopLeft, LegendPlace::BottomRight, LegendPlace::BottomLeft}) {
      const int under = pointsUnder(isRight(corner) ? width_ - legendWidth_ : 0, isBottom(corner) ? height_ - legendHeight_ : 0,
                                    legendWidth_, legendHeight_);
      if (under < fewest) fewest = under, place_ = corner;
    }
    if (fewest > 0 || legendWidth_ > 0.6 * width_) place_ = LegendPlace::Below;  // a legend over data hides what it explains
  }
  if (place_ == LegendPlace::Below) {
    const int fit = static_cast<int>((width_ + 40 - 2 * kLegendPad + 8) / (column + 8));
    shape(std::clamp(fit, 1, static_cast<int>(entries_.size())));
  }
}

int PanelPainter::pointsUnder(double x, double y, double width, double height) const {
  int count = 0;
  const auto test = [&](double px, double py) { count += px >= x && px <= x + width && py >= y && py <= y + height; };
  const auto along = [&](const std::vector<double>& xs, const std::vector<double>& ys) {
    for (std::size_t i = 0; i < xs.size() && i < ys.size(); ++i) {
      const double px = xAt(xs[i]), py = yAt(ys[i]);
      test(px, py);
      if (i == 0) continue;
      const double qx = xAt(xs[i - 1]), qy = yAt(ys[i - 1]);
      for (int k = 1; k < 8; ++k) test(qx + (px - qx) * k / 8, qy + (py - qy) * k / 8);  // a long segment may cross a corner
    }
  };
  for (const Series& s : panel_.series) {
    along(s.x, s.y);
    if (!s.errorHigh.empty()) along(s.x, s.errorHigh), along(s.x, s.errorLow);
  }
  for (const Band& b : panel_.bands) along(b.x, b.low), along(b.x, b.high);
  return count;
}

void PanelPainter::measure() {
  canvas_.setFont(kTickFont);
  double tickWidth = 0;
  for (const auto& tick : y_.major) tickWidth = std::max(tickWidth, canvas_.textWidth(tick.second));
  const double lastTick = x_.major.empty() ? 0 : canvas_.textWidth(x_.major.back().second) / 2;
  margins_.left = kTickLength + kGap + tickWidth + (panel_.y.label.empty() ? 0 : kLabelFont + 5);
  margins_.right = std::max(4.0, lastTick);
  margins_.bottom = kTickLength + kGap + kTickFont + (panel_.x.label.empty() ? 0 : kLabelFont + 4);
  margins_.top = panel_.title.empty() ? 4 : kTitleFont + 7;
  for (const Rule& rule : panel_.rules) {
    if (rule.label.empty()) continue;
    if (rule.vertical) margins_.top = std::max(margins_.top, (panel_.title.empty() ? 0 : kTitleFont + 4) + kTickFont + 4);
    else margins_.right = std::max(margins_.right, canvas_.textWidth(rule.label) + 2 * kGap);
  }
  canvas_.setFont(kLabelFont);
  const double labelBeyond = (canvas_.textWidth(panel_.x.label) - width_) / 2;  // at either end
  for (double* side : {&margins_.left, &margins_.right}) *side = std::max(*side, labelBeyond + kGap);
  if (place_ == LegendPlace::Below) {
    margins_.bottom += legendHeight_ + 2;
    for (double* side : {&margins_.left, &margins_.right}) *side = std::max(*side, (legendWidth_ - width_) / 2);
  }
  if (place_ == LegendPlace::Right) margins_.right += legendWidth_ + 4;
}

void PanelPainter::draw(double left, double top, double topMargin) {
  left_ = left;
  top_ = top;
  cairo_t* context = canvas_.context();
  drawAxes(topMargin);
  cairo_save(context);
  cairo_rectangle(context, left_ - kEdge, top_ - kEdge, width_ + 2 * kEdge, height_ + 2 * kEdge);
  cairo_clip(context);
  for (const Band& band : panel_.bands) drawBand(band);
  for (const Rule& rule : panel_.rules) drawRule(rule);
  for (const Series& series : panel_.series) drawSeries(series);
  cairo_restore(context);

  canvas_.setFont(kTickFont);
  for (const Word& word : panel_.words) {
    canvas_.setColor(word.color);
    canvas_.text(left_ + xAt(word.x), top_ + yAt(word.y) + 0.36 * kTickFont, word.text, Align::Centre);
  }
  drawRuleLabels();
  drawLegend();
}

void PanelPainter::drawRuleLabels() {
  std::vector<std::pair<double, const Rule*>> beside;
  for (const Rule& rule : panel_.rules)
    if (!rule.vertical && !rule.label.empty()) beside.emplace_back(yAt(rule.at), &rule);
  // Rules that lie close keep their order, and their labels a line each.
  std::sort(beside.begin(), beside.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 1; i < beside.size(); ++i) {
    const double overlap = beside[i - 1].first + kTickFont - beside[i].first;
    if (overlap <= 0) continue;
    beside[i - 1].first -= overlap / 2;
    beside[i].first += overlap / 2;
  }
  for (const auto& [y, rule] : beside) {
    canvas_.setColor(rule->color);
    canvas_.text(left_ + width_ + kGap, top_ + y + 0.35 * kTickFont, rule->label);
  }
  for (const Rule& rule : panel_.rules) {
    canvas_.setColor(rule.color);
    if (rule.vertical) canvas_.text(left_ + xAt(rule.at), top_ - 3, rule.label, Align::Centre);
  }
}

void PanelPainter::drawAxes(double topMargin) {
  const double right = left_ + width_, bottom = top_ + height_;
  // A faint grid only where values are read off by decades.
  const Color grid{0.88, 0.88, 0.88};
  canvas_.setStroke(grid, 0.4);
  if (panel_.x.scale == Scale::Log)
    for (const auto& tick : x_.major) canvas_.line(left_ + xAt(tick.first), top_, left_ + xAt(tick.first), bottom);
  if (panel_.y.scale == Scale::Log)
    for (const auto& tick : y_.major) canvas_.line(left_, top_ + yAt(tick.first), right, top_ + yAt(tick.first));
  if (panel_.y.scale == Scale::Linear && y_.from < 0 && y_.to > 0 && panel_.y.ticks.empty())
    canvas_.line(left_, top_ + yAt(0), right, top_ + yAt(0));

  canvas_.setStroke(kInk, 0.7);
  canvas_.line(left_, top_, left_, bottom);
  canvas_.line(left_, bottom, right, bottom);
  for (const auto& tick : x_.major) canvas_.line(left_ + xAt(tick.first), bottom, left_ + xAt(tick.first), bottom + kTickLength);
  for (const auto& tick : y_.major) canvas_.line(left_, top_ + yAt(tick.first), left_ - kTickLength, top_ + yAt(tick.first));
  canvas_.setStroke(kInk, 0.4);
  for (const double at : x_.minor) canvas_.line(left_ + xAt(at), bottom, left_ + xAt(at), bottom + 0.55 * kTickLength);
  for (const double at : y_.minor) canvas_.line(left_, top_ + yAt(at), left_ - 0.55 * kTickLength, top_ + yAt(at));

  canvas_.setColor(kInk);
  canvas_.setFont(kTickFont);
  double tickWidth = 0;
  for (const auto& tick : x_.major)
    canvas_.text(left_ + xAt(tick.first), bottom + kTickLength + kGap + 0.75 * kTickFont, tick.second, Align::Centre);
  for (const auto& tick : y_.major) {
    canvas_.text(left_ - kTickLength - kGap, top_ + yAt(tick.first) + 0.36 * kTickFont, tick.second, Align::Right);
    tickWidth = std::max(tickWidth, canvas_.textWidth(tick.second));
  }
  canvas_.setFont(kLabelFont);
  canvas_.text(left_ + width_ / 2, bottom + kTickLength + kGap + kTickFont + kLabelFont + 2, panel_.x.label, Align::Centre);
  canvas_.textUpwards(left_ - kTickLength - kGap - tickWidth - 6, top_ + height_ / 2, panel_.y.label);
  canvas_.setFont(kTitleFont, true);
  canvas_.text(left_, top_ - topMargin + kTitleFont, panel_.title);
}

void PanelPainter::drawBand(const Band& band) {
  cairo_t* context = canvas_.context();
  const std::size_t n = std::min({band.x.size(), band.low.size(), band.high.size()});
  const auto good = [&](std::size_t i) {
    return std::isfinite(xAt(band.x[i])) && std::isfinite(yAt(band.low[i])) && std::isfinite(yAt(band.high[i]));
  };
  canvas_.setColor(band.color);
  for (std::size_t i = 0; i < n;) {
    if (!good(i)) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < n && good(end)) ++end;
    for (std::size_t k = i; k < end; ++k) cairo_line_to(context, left_ + xAt(band.x[k]), top_ + yAt(band.high[k]));
    for (std::size_t k = end; k-- > i;) cairo_line_to(context, left_ + xAt(band.x[k]), top_ + yAt(band.low[k]));
    cairo_close_path(context);
    cairo_fill(context);
    i = end;
  }
}

void PanelPainter::drawSeries(const Series& s) {
  cairo_t* context = canvas_.context();
  const std::size_t n = std::min(s.x.size(), s.y.size());
  // Far outside the panel a coordinate says nothing more and could overflow the renderer.
  const auto px = [&](double value) { return left_ + std::clamp(xAt(value), -10 * width_, 11 * width_); };
  const auto py = [&](double value) { return top_ + std::clamp(yAt(value), -10 * height_, 11 * height_); };
  const auto good = [&](double x, double y) { return std::isfinite(xAt(x)) && std::isfinite(yAt(y)); };
  if (s.width > 0) {
    canvas_.setStroke(s.color, s.width, s.dash);
    bool open = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (!good(s.x[i], s.y[i])) open = false;
      else if (open) cairo_line_to(context, px(s.x[i]), py(s.y[i]));
      else cairo_move_to(context, px(s.x[i]), py(s.y[i])), open = true;
    }
    cairo_stroke(context);
  }
  const double cap = std::max(1.5, s.markerSize / 2);
  canvas_.setStroke(s.color, 0.8);
  for (std::size_t i = 0; i < n; ++i) {
    if (i < s.errorLow.size() && i < s.errorHigh.size() && good(s.x[i], s.errorLow[i]) && good(s.x[i], s.errorHigh[i])) {
      canvas_.line(px(s.x[i]), py(s.errorLow[i]), px(s.x[i]), py(s.errorHigh[i]));
      for (const double end : {s.errorLow[i], s.errorHigh[i]}) canvas_.line(px(s.x[i]) - cap, py(end), px(s.x[i]) + cap, py(end));
    }
  }
  if (s.marker != MarkerShape::None)
    for (std::size_t i = 0; i < n; ++i)
      if (good(s.x[i], s.y[i])) canvas_.marker(s.marker, px(s.x[i]), py(s.y[i]), s.markerSize, s.color);
}

void PanelPainter::drawRule(const Rule& rule) {
  canvas_.setStroke(rule.color, 0.6, rule.dash);
  if (rule.vertical) canvas_.line(left_ + xAt(rule.at), top_, left_ + xAt(rule.at), top_ + height_);
  else canvas_.line(left_, top_ + yAt(rule.at), left_ + width_, top_ + yAt(rule.at));
}

void PanelPainter::drawEntry(const Entry& entry, double x, double baseline) {
  const double middle = baseline - 0.33 * kLegendFont;
  if (entry.band) {
    canvas_.setColor(entry.band->color);
    canvas_.fillBox(x, middle - 3, kSample, 6);
  } else {
    const Series& s = *entry.series;
    if (s.width > 0) {
      Color color = s.color;
      color.alpha = std::max(color.alpha, 0.6);  // one faded line alone could not be seen
      canvas_.setStroke(color, s.width, s.dash);
      canvas_.line(x, middle, x + kSample, middle);
    }
    canvas_.marker(s.marker, x + kSample / 2, middle, s.markerSize, s.color);
  }
  canvas_.setFont(kLegendFont);
  canvas_.setColor(kInk);
  canvas_.text(x + kSample + kGap, baseline, entry.label());
}

void PanelPainter::drawLegend() {
  if (place_ == LegendPlace::None) return;
  double x = left_ + (isRight(place_) ? width_ - legendWidth_ : 4), y = top_ + (isBottom(place_) ? height_ - legendHeight_ - 2 : 2);
  if (place_ == LegendPlace::Right) {
    x = left_ + width_ + 6;
  } else if (place_ == LegendPlace::Below) {
    x = left_ + (width_ - legendWidth_) / 2;
    y = top_ + height_ + kTickLength + kGap + kTickFont + (panel_.x.label.empty() ? 0 : kLabelFont + 4) + 2;
  } else {
    canvas_.setColor({1, 1, 1, 0.85});
    canvas_.fillBox(x, y, legendWidth_, legendHeight_);
  }
  const double column = (legendWidth_ - 2 * kLegendPad - (legendColumns_ - 1) * 8) / legendColumns_ + 8;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const int row = static_cast<int>(i) / legendColumns_, at = static_cast<int>(i) % legendColumns_;
    drawEntry(entries_[i], x + kLegendPad + at * column, y + kLegendPad + 6 + row * kLegendLine);
  }
}

}  // namespace reachlab::figure
