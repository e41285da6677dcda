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

TEST(Picture, OfAPanelIsAsLargeAsAskedFor) {
  const Box box = areaOf(plain());
  EXPECT_NEAR(box.width(), kWide, kNear);
  EXPECT_NEAR(box.height(), kHigh, kNear);
  const Figure usual;
  EXPECT_EQ(usual.panelWidth, 75);
  EXPECT_EQ(usual.panelHeight, 50);
  EXPECT_EQ(usual.columns, 1);
}

TEST(Picture, OfAPointIsWhereItsValuesAre) {
  Panel panel = plain();
  panel.series = {points({4, 10}, {3, 0}, kRed), points({2, 12}, {-1, 4}, kBlue, MarkerShape::Square, 1)};
  const Box in = areaOf(plain());
  const Picture picture(figureOf(panel));
  const Box left = picture.find(kRed, {in.left, in.top, in.x(), in.bottom}),
            right = picture.find(kRed, {in.x(), in.top, in.right, in.bottom});
  EXPECT_NEAR(left.x() - in.left, 0.2 * kWide, kNear);
  EXPECT_NEAR(left.y() - in.top, 0.2 * kHigh, kNear);
  EXPECT_NEAR(right.x() - in.left, 0.8 * kWide, kNear);
  EXPECT_NEAR(right.y() - in.top, 0.8 * kHigh, kNear);
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

TEST(Picture, OfErrorBarsReachesFromEndToEndWithCaps) {
  Panel panel = plain();
  Series s = points({6}, {1}, kRed, MarkerShape::None, 10);
  s.errorLow = {0}, s.errorHigh = {3};
  panel.series = {s};
  const Box in = areaOf(plain());
  const auto up = [&](double y) { return in.top + kHigh * (4 - y) / 5; };
  const auto right = [&](double x) { return in.left + kWide * (x - 2) / 10; };
  Box box = Picture(figureOf(panel)).find(kRed);
  EXPECT_NEAR(box.top, up(3) - 0.4, kNear);
  EXPECT_NEAR(box.bottom, up(0) + 0.4, kNear);
  EXPECT_NEAR(box.x(), right(6), kNear);
  EXPECT_NEAR(box.width(), 10, kNear) << "caps of the marker's size";
  Picture picture(figureOf(panel));
  EXPECT_EQ(picture.along(true, up(1.7), kRed).size(), 1u);
  EXPECT_LT(picture.along(true, up(1.7), kRed)[0].second - picture.along(true, up(1.7), kRed)[0].first, 1.2);
  panel.series[0].markerSize = 1;
  EXPECT_NEAR(Picture(figureOf(panel)).find(kRed).width(), 3, kNear) << "but 3 pt at least";
  panel.series[0].errorLow.clear(), panel.series[0].errorHigh.clear();
  panel.series[0].errorLeft = {3}, panel.series[0].errorRight = {11};
  panel.series[0].markerSize = 10;
  box = Picture(figureOf(panel)).find(kRed);
  EXPECT_NEAR(box.left, right(3) - 0.4, kNear);
  EXPECT_NEAR(box.right, right(11) + 0.4, kNear);
  EXPECT_NEAR(box.y(), up(1), kNear);
  EXPECT_NEAR(box.height(), 10, kNear);
  panel.series[0].errorRight = {std::nan("")};
  EXPECT_TRUE(Picture(figureOf(panel)).find(kRed).empty());
}

TEST(Picture, OfABandIsWhatLiesBetweenItsCurves) {
  Panel panel = plain();
  Band band;
  band.x = {4, 8, 9, 10, 11}, band.low = {0, 1, std::nan(""), 0, 0}, band.high = {2, 3, 3, 1, 1};
  band.color = kRed;
  panel.bands = {band};
  const Box in = areaOf(plain());
  const Picture picture(figureOf(panel));
  const auto at = [&](double x, double y) { return picture.at(in.left + kWide * (x - 2) / 10, in.top + kHigh * (4 - y) / 5).green < 0.5; };
  EXPECT_TRUE(at(4.1, 0.2) && at(4.1, 1.8) && at(7.9, 1.2) && at(7.9, 2.8) && at(6, 1.5));
  EXPECT_FALSE(at(4.1, -0.2) || at(4.1, 2.3) || at(7.9, 0.7) || at(7.9, 3.2) || at(3.9, 1) || at(8.5, 2));
  EXPECT_TRUE(at(10.5, 0.5)) << "beyond the hole it goes on";
  EXPECT_FALSE(at(9.5, 0.5));
}

TEST(Picture, OfRulesCrossesThePanelWithAWordAtTheEnd) {
  Panel panel = plain();
  panel.rules = {{3, false, "H", kBlue, Dash::Solid}, {5, true, "H", kRed, Dash::Solid}};
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  const Box down = picture.find(kRed, {in.left + 40, in.top - 1.5, in.left + 80, 1e6});
  const Box word = picture.find(kRed, {in.left, 0, in.right, in.top - 2}), beside = picture.find(kBlue, {in.right + 2, 0, 1e6, 1e6});
  EXPECT_NEAR(down.top, in.top, kNear);
  EXPECT_NEAR(down.bottom, in.bottom, 2 * kNear);
  EXPECT_NEAR(down.width(), 0.6, 0.26);
  EXPECT_NEAR(word.x(), in.left + 0.3 * kWide, 2 * kNear) << "centred above it";
  EXPECT_NEAR(word.bottom, in.top - 3, 2 * kNear);
  EXPECT_NEAR(word.height(), 0.73 * 7, 0.4) << "a capital of 7 pt";
  EXPECT_NEAR(beside.left, in.right + 3, 1) << "a letter's own margin";
  EXPECT_NEAR(beside.y(), in.top + 0.2 * kHigh, 0.6);
  EXPECT_NEAR(picture.find(kBlue, {in.left + 5, in.top, in.right - 5, in.bottom}).y(), in.top + 0.2 * kHigh, kNear);
}

TEST(Picture, OfAxesHasTicksOutsideAtTheirPlaces) {
  Panel panel = plain();
  panel.y.from = 0.0;
  panel.x.ticks = {{4, "I"}, {9, "I"}};
  panel.y.ticks = {{1, "I"}, {3, "I"}};
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  for (const double out : {1.0, 2.6}) {
    const auto below = picture.along(true, in.bottom + out, kInk, in.left + 1),
               left = picture.along(false, in.left - out, kInk, 0, in.bottom - 1);
    ASSERT_EQ(below.size(), 2u) << out;
    EXPECT_NEAR((below[0].first + below[0].second) / 2, in.left + 0.2 * kWide, kNear);
    EXPECT_NEAR((below[1].first + below[1].second) / 2, in.left + 0.7 * kWide, kNear);
    ASSERT_EQ(left.size(), 2u) << out;
    EXPECT_NEAR((left[0].first + left[0].second) / 2, in.top + 0.25 * kHigh, kNear);
    EXPECT_NEAR((left[1].first + left[1].second) / 2, in.top + 0.75 * kHigh, kNear);
  }
  EXPECT_TRUE(picture.find(kInk, {in.left + 1, in.bottom + 3.4, in.right, in.bottom + 5}).empty()) << "3 pt long";
  // Their words: centred below, and at the left, upright.
  const Box under = picture.find(kInk, {in.left + 1, in.bottom + 5, in.x(), 1e6}), beside = picture.find(kInk, {0, 0, in.left - 4, in.y()});
  EXPECT_NEAR(under.x(), in.left + 0.2 * kWide, 2 * kNear);
  EXPECT_NEAR(under.bottom, in.bottom + 3 + 3 + 0.75 * 7, 0.4);
  EXPECT_NEAR(beside.y(), in.top + 0.25 * kHigh, 0.5);
  EXPECT_NEAR(beside.right, in.left - 6, 1);
  const auto axis = picture.along(true, in.y(), kInk, in.left - 2, in.left + 2);
  ASSERT_EQ(axis.size(), 1u);
  EXPECT_NEAR(axis[0].second - axis[0].first, 0.7, 0.26);
  EXPECT_NEAR((axis[0].second + axis[0].first) / 2, in.left, kNear);
  const auto floor = picture.along(false, in.x(), kInk, in.bottom - 2, in.bottom + 2);
  ASSERT_EQ(floor.size(), 1u);
  EXPECT_NEAR((floor[0].second + floor[0].first) / 2, in.bottom, kNear);
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

TEST(Picture, OfALegendHasALineForEachAndSamplesAsTheyAreDrawn) {
  Panel panel = withLegend(LegendPlace::TopLeft);
  Band band;
  band.label = "H", band.color = kGreen;
  panel.bands = {band};
  Series faded = line({}, {}, {0, 0, 1, 0.1});
  faded.label = "H";
  panel.series.push_back(faded);
  Series marked = points({}, {}, kPink, MarkerShape::Square, 10);
  marked.label = "H";
  panel.series.push_back(marked);
  panel.series.push_back(line({}, {}, {0, 0.5, 0}));  // without a name
  const Picture picture(figureOf(panel));
  const Box green = picture.find(kGreen), red = picture.find(kRed), pink = picture.find(kPink);
  EXPECT_NEAR(green.height(), 6, kNear) << "bands first";
  EXPECT_NEAR(green.width(), 20, kNear);
  EXPECT_NEAR(red.y() - green.y(), 10.5, kNear);
  EXPECT_NEAR(pink.y() - green.y(), 31.5, kNear);
  EXPECT_NEAR(pink.x(), red.x(), kNear) << "in the middle of its sample";
  EXPECT_NEAR(pink.width(), 8.8, kNear);
  const Box blue = picture.find({0.4, 0.4, 1});
  EXPECT_NEAR(blue.y() - green.y(), 21, kNear) << "one faded line alone could not be seen: 60 % at least";
  EXPECT_TRUE(picture.find({0, 0.5, 0}).empty());
  const Box words = picture.find(kInk, {green.right + 1, green.top, green.right + 20, green.bottom});
  EXPECT_NEAR(words.left, green.right + 3, 1);
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
