#include "tests/figure/picture.h"

#include <gtest/gtest.h>

#include <array>

namespace reachlab::figure {
namespace {

constexpr double kMillimetre = 72 / 25.4;   // [pt]
constexpr double kWide = 200, kHigh = 100;  // [pt] of a panel
constexpr double kNear = 0.35;              // [pt] a pixel and a half, and what is only partly covered
constexpr Color kRed{1, 0, 0}, kGreen{0, 1, 0}, kBlue{0, 0, 1}, kPink{1, 0, 1}, kInk{0.15, 0.15, 0.15}, kWhite{1, 1, 1},
    kFaint{0.88, 0.88, 0.88};

/// x from 2 to 12, y from -1 to 4, with a word that is not seen.
Panel plain() {
  Panel panel;
  panel.words = {{7, 1.5, " "}};
  panel.x.from = 2.0, panel.x.to = 12.0;
  panel.y.from = -1.0, panel.y.to = 4.0;
  return panel;
}
Figure figureOf(const Panel& panel) {
  Figure figure;
  figure.panelWidth = kWide / kMillimetre, figure.panelHeight = kHigh / kMillimetre;
  figure.panels = {panel};
  return figure;
}
Band area(const Color& color) {
  Band band;
  band.x = {2, 12}, band.low = {-1, -1}, band.high = {4, 4};
  band.color = color;
  return band;
}
Series points(std::vector<double> x, std::vector<double> y, const Color& color, MarkerShape marker = MarkerShape::Square, double size = 6) {
  Series s;
  s.x = std::move(x), s.y = std::move(y);
  s.color = color, s.marker = marker, s.markerSize = size, s.width = 0;
  return s;
}
Series line(std::vector<double> x, std::vector<double> y, const Color& color, double width = 2) {
  Series s = points(std::move(x), std::move(y), color, MarkerShape::None);
  s.width = width;
  return s;
}
/// Where the plotting area lies, by a band that fills it: everything else keeps its place.
Box areaOf(Panel panel) {
  panel.series.clear(), panel.words.clear();
  for (Rule& rule : panel.rules) rule.color = {0.5, 0.5, 0.5};
  panel.bands = {area(kGreen)};
  panel.bands[0].x = {panel.x.from.value_or(2), panel.x.to.value_or(12)};
  panel.bands[0].low.assign(2, panel.y.from.value_or(-1)), panel.bands[0].high.assign(2, panel.y.to.value_or(4));
  const Box box = Picture(figureOf(panel)).find(kGreen);
  // Half of the axes' lines, 0.7 pt thick, lies outside: of the band it hides nothing.
  return box;
}

TEST(Picture, OfALogarithmicAxisHasDecadesOfOneLengthAndAGrid) {
  Panel panel = plain();
  panel.x.scale = panel.y.scale = Scale::Log;
  panel.x.from = 1.0, panel.x.to = 1000.0;
  panel.y.from = 0.01, panel.y.to = 100.0;
  const Box in = areaOf(panel);
  panel.series = {points({10, -3, 100}, {1, 1, 0}, kRed)};
  const Picture picture(figureOf(panel));
  const Box at = picture.find(kRed);
  EXPECT_NEAR(at.x() - in.left, kWide / 3, kNear);
  EXPECT_NEAR(at.y() - in.top, kHigh / 2, kNear);
  EXPECT_NEAR(at.width(), 0.88 * 6, kNear) << "what is not above 0 has no place";
  const auto across = picture.along(true, in.top + 0.4 * kHigh, kFaint, in.left + 2, in.right - 2);
  ASSERT_EQ(across.size(), 2u) << "10 and 100";
  EXPECT_NEAR((across[1].first + across[1].second) / 2 - in.left, 2 * kWide / 3, kNear);
  const auto down = picture.along(false, in.left + 0.5 * kWide, kFaint, in.top + 2, in.bottom - 2);
  ASSERT_EQ(down.size(), 1u) << "every second decade has a name and a line";
  EXPECT_NEAR((down[0].first + down[0].second) / 2 - in.top, kHigh / 2, kNear);
}

/// One labelled red line: the sample in its legend is red and lies outside the series, which has no points.
Panel withLegend(LegendPlace place) {
  Panel panel = plain();
  Series s = line({}, {}, kRed);
  s.label = "HH";
  panel.series = {s};
  panel.legend = place;
  return panel;
}

// In the corner with the fewest data, below where all have some.
TEST(Picture, OfALegendKeepsOutOfTheData) {
  const Box in = areaOf(plain());
  const auto sampleWith = [](const std::vector<std::pair<double, double>>& places) {
    Panel panel = withLegend(LegendPlace::Auto);
    for (const auto& [x, y] : places) panel.series.push_back(points({x}, {y}, kBlue));
    return Picture(figureOf(panel)).find(kRed);
  };
  const std::pair<double, double> topRight{11.5, 3.8}, topLeft{2.5, 3.8}, bottomRight{11.5, -0.8}, bottomLeft{2.5, -0.8};
  const auto isAt = [&](const Box& sample, bool right, bool bottom) {
    return (sample.x() > in.x()) == right && (sample.y() > in.y()) == bottom && sample.bottom < in.bottom;
  };
  EXPECT_TRUE(isAt(sampleWith({}), true, false));
  EXPECT_TRUE(isAt(sampleWith({topRight}), false, false));
  EXPECT_TRUE(isAt(sampleWith({topRight, topLeft}), true, true));
  EXPECT_TRUE(isAt(sampleWith({topRight, topLeft, bottomRight}), false, true));
  EXPECT_GT(sampleWith({topRight, topLeft, bottomRight, bottomLeft}).y(), in.bottom);
  // A line that crosses the corner without a point in it, and a band's edge.
  Panel crossed = withLegend(LegendPlace::Auto);
  crossed.series.push_back(line({7, 12}, {4, 3}, kBlue, 1));
  EXPECT_FALSE(isAt(Picture(figureOf(crossed)).find(kRed), true, false));
  Panel banded = withLegend(LegendPlace::Auto);
  banded.bands = {area(kBlue)};
  banded.bands[0].low = {0.5, 0.5}, banded.bands[0].high = {3.9, 3.9};
  EXPECT_TRUE(isAt(Picture(figureOf(banded)).find(kRed), true, true));
}

}  // namespace
}  // namespace reachlab::figure
