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
Series points(std::vector<double> x, std::vector<double> y, const Color& color, Marker marker = Marker::Square, double size = 6) {
  Series s;
  s.x = std::move(x), s.y = std::move(y);
  s.color = color, s.marker = marker, s.markerSize = size, s.width = 0;
  return s;
}
Series line(std::vector<double> x, std::vector<double> y, const Color& color, double width = 2) {
  Series s = points(std::move(x), std::move(y), color, Marker::None);
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
  panel.series = {points({4, 10}, {3, 0}, kRed), points({2, 12}, {-1, 4}, kBlue, Marker::Square, 1)};
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

TEST(Picture, OfALinearAxisThatPassesNoughtHasALineThere) {
  const Panel panel = plain();
  const Box in = areaOf(panel);
  const auto down = Picture(figureOf(panel)).along(false, in.x() + 3, kFaint, in.top + 2, in.bottom - 2);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_NEAR((down[0].first + down[0].second) / 2 - in.top, 0.8 * kHigh, kNear);
  Panel named = panel, above = panel, below = panel;
  named.y.ticks = {{1, "one"}};
  above.y.from = 0.0;
  below.y.to = 0.0;
  for (const Panel& without : {named, above, below}) {
    const Box own = areaOf(without);
    EXPECT_TRUE(Picture(figureOf(without)).find(kFaint, {own.left + 2, own.top + 2, own.right - 2, own.bottom - 2}).empty());
  }
}

TEST(Picture, OfMarkersHasTheirShapes) {
  const auto boxOf = [](Marker marker) {
    Panel panel = plain();
    panel.series = {points({7}, {1.5}, kRed, marker, 20)};
    return Picture(figureOf(panel)).find(kRed);
  };
  const Box in = areaOf(plain());
  const struct {
    Marker marker;
    double width, up, down;
  } shapes[] = {
      {Marker::Circle, 20, 10, 10}, {Marker::Square, 17.6, 8.8, 8.8}, {Marker::Triangle, 20, 11.5, 7.5}, {Marker::Diamond, 24, 12, 12}};
  for (const auto& shape : shapes) {
    const Box box = boxOf(shape.marker);
    EXPECT_NEAR(box.width(), shape.width, 2 * kNear);
    EXPECT_NEAR(box.x() - in.x(), 0, kNear);
    EXPECT_NEAR(in.y() - box.top, shape.up, 2 * kNear);
    EXPECT_NEAR(box.bottom - in.y(), shape.down, 2 * kNear);
  }
  EXPECT_TRUE(boxOf(Marker::None).empty());
  Panel panel = plain();
  panel.series = {points({7}, {1.5}, kRed, Marker::Cross, 20)};
  const Picture cross(figureOf(panel));
  for (const double far : {-8.0, 0.0, 8.0})
    for (const double side : {-1.0, 1.0}) EXPECT_TRUE(cross.isAt(in.x() + far, in.y() + side * far, kRed)) << far;
  EXPECT_TRUE(cross.isAt(in.x() + 8, in.y(), kWhite));
  const auto arm = cross.along(true, in.y() + 6, kRed, in.x(), in.right);
  ASSERT_EQ(arm.size(), 1u);
  EXPECT_NEAR(arm[0].second - arm[0].first, 5 * std::sqrt(2.0), 2 * kNear) << "a quarter of its size thick, seen askew";
  panel.series[0].marker = Marker::Circle;
  const Picture circle(figureOf(panel));
  EXPECT_TRUE(circle.isAt(in.x() + 6.5, in.y() - 6.5, kRed));
  EXPECT_TRUE(circle.isAt(in.x() + 7.7, in.y() - 7.7, kWhite));
  panel.series[0].marker = Marker::Triangle;
  const Picture triangle(figureOf(panel));
  EXPECT_TRUE(triangle.isAt(in.x() - 8.5, in.y() + 6.5, kRed));
  EXPECT_TRUE(triangle.isAt(in.x() + 8.5, in.y() + 6.5, kRed));
  EXPECT_TRUE(triangle.isAt(in.x() + 6, in.y() - 6, kWhite));
}

TEST(Picture, OfLinesHasTheirWidthAndTheirGaps) {
  Panel panel = plain();
  panel.series = {line({2, 12}, {1.5, 1.5}, kRed, 4)};
  const Box in = areaOf(plain());
  EXPECT_NEAR(Picture(figureOf(panel)).find(kRed).height(), 4, kNear);
  // On, off … of a line 2 pt wide, by the multiples of its width.
  const std::pair<Dash, std::vector<double>> patterns[] = {
      {Dash::Dashed, {9, 5, 9, 5}}, {Dash::Dotted, {2.4, 4, 2.4, 4}}, {Dash::DashDot, {10, 4, 2.4, 4, 10, 4}}, {Dash::Solid, {200}}};
  for (const auto& [dash, lengths] : patterns) {
    panel.series = {line({2, 12}, {1.5, 1.5}, kRed, 2)};
    panel.series[0].dash = dash;
    const auto runs = Picture(figureOf(panel)).along(true, in.y(), kRed, in.left - 0.5);
    double at = in.left;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      if (i % 2 == 0) {
        ASSERT_LT(i / 2, runs.size());
        EXPECT_NEAR(runs[i / 2].first, at, 2 * kNear);
        EXPECT_NEAR(runs[i / 2].second, at + lengths[i], 2 * kNear);
      }
      at += lengths[i];
    }
  }
}

TEST(Picture, OfASeriesWithAHoleHasAGap) {
  Panel panel = plain();
  panel.series = {line({2, 5, 7, 9, 12}, {1.5, 1.5, std::nan(""), 1.5, 1.5}, kRed)};
  const Box in = areaOf(plain());
  const auto runs = Picture(figureOf(panel)).along(true, in.y(), kRed);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_NEAR(runs[0].second - in.left, 0.3 * kWide, kNear);
  EXPECT_NEAR(runs[1].first - in.left, 0.7 * kWide, kNear);
}

TEST(Picture, OfErrorBarsReachesFromEndToEndWithCaps) {
  Panel panel = plain();
  Series s = points({6}, {1}, kRed, Marker::None, 10);
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

// A blank line between them, and the pair keeps its middle.
TEST(Picture, OfRulesThatLieCloseHasTheirWordsApart) {
  Panel panel = plain();
  panel.rules = {{3, false, "H", kRed}, {3.1, false, "H", kBlue}, {0, false, "H", kPink}};
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  const Box outside{in.right + 2, 0, 1e6, 1e6};
  const Box red = picture.find(kRed, outside), blue = picture.find(kBlue, outside), pink = picture.find(kPink, outside);
  EXPECT_NEAR(red.y() - blue.y(), 7, kNear) << "the higher one above";
  EXPECT_NEAR((red.y() + blue.y()) / 2, in.top + 0.19 * kHigh, 0.6);
  EXPECT_NEAR(pink.y(), in.top + 0.8 * kHigh, 0.6) << "what is apart stays";
}

TEST(Picture, OfAWordIsCentredOnItsPlace) {
  Panel panel = plain();
  panel.words = {{9.5, 2, "H", kRed}};
  const Box in = areaOf(plain()), word = Picture(figureOf(panel)).find(kRed);
  EXPECT_NEAR(word.x() - in.left, 0.75 * kWide, 2 * kNear);
  EXPECT_NEAR(word.y() - in.top, 0.4 * kHigh, 2 * kNear);
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

TEST(Picture, OfMinorTicksIsShorter) {
  Panel panel = plain();
  panel.x.scale = panel.y.scale = Scale::Log;
  panel.x.from = panel.y.from = 1.0, panel.x.to = 1000.0, panel.y.to = 100.0;
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  const auto count = [&](bool below, double out) {
    // Thin lines hardly ever cover a pixel whole: anything dark counts.
    int n = 0;
    bool inside = false;
    const double from = below ? in.left + 2 : in.top - 1, to = below ? in.right + 2 : in.bottom - 2;
    for (double at = from; at < to; at += 0.125) {
      const bool dark = (below ? picture.at(at, in.bottom + out) : picture.at(in.left - out, at)).red < 0.8;
      n += dark && !inside;
      inside = dark;
    }
    return n;
  };
  EXPECT_EQ(count(true, 1), 27) << "8 between each pair of the 3 decades, and the 3 that follow the first";
  EXPECT_EQ(count(false, 1), 18) << "two decades";
  EXPECT_EQ(count(true, 2.4), 3);
  EXPECT_EQ(count(false, 2.4), 2);
}

TEST(Picture, OfItsWordsStandsAroundThePanel) {
  Panel panel = plain();
  panel.title = "H", panel.x.label = "H", panel.y.label = "H";
  panel.x.ticks = panel.y.ticks = {{100, "none"}};
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  const Box title = picture.find(kInk, {in.left - 1, 0, in.right, in.top - 2}),
            below = picture.find(kInk, {in.left + 2, in.bottom + 2, in.right, 1e6}),
            left = picture.find(kInk, {0, in.top, in.left - 2, in.bottom});
  EXPECT_NEAR(title.left, in.left, 1.2);
  EXPECT_NEAR(title.height(), 0.73 * 8.5, 0.4);
  EXPECT_NEAR(title.bottom, in.top - 7, 0.4) << "15.5 pt are above, 8.5 of them its own";
  EXPECT_NEAR(below.x(), in.x(), 2 * kNear);
  EXPECT_NEAR(below.height(), 0.73 * 8, 0.4);
  EXPECT_NEAR(below.bottom, in.bottom + 3 + 3 + 7 + 8 + 2, 0.4);
  EXPECT_NEAR(left.y(), in.y(), 2 * kNear);
  EXPECT_NEAR(left.width(), 0.73 * 8, 0.4) << "it reads upwards";
  EXPECT_NEAR(left.right, in.left - 3 - 3 - 6, 0.4) << "no tick has a width";
  EXPECT_NEAR(in.left, 4 + 3 + 3 + 8 + 5, kNear) << "4 pt around everything";
  EXPECT_NEAR(in.top, 4 + 8.5 + 7, kNear);
  EXPECT_NEAR(picture.height() - in.bottom, 4 + 3 + 3 + 7 + 8 + 4, kNear);
  EXPECT_NEAR(picture.width() - in.right, 4 + 4, kNear);
}

TEST(Picture, WithoutWordsHasNoRoomForThem) {
  Panel panel = plain();
  panel.x.ticks = panel.y.ticks = {{100, "none"}};
  const Box in = areaOf(panel);
  const Picture picture(figureOf(panel));
  EXPECT_NEAR(in.left, 4 + 3 + 3, kNear);
  EXPECT_NEAR(in.top, 4 + 4, kNear);
  EXPECT_NEAR(picture.height() - in.bottom, 4 + 3 + 3 + 7, kNear);
  panel.rules = {{5, true, "H", kRed}};
  EXPECT_NEAR(areaOf(panel).top, 4 + 7 + 4, kNear);
  panel.title = "H";
  EXPECT_NEAR(areaOf(panel).top, 4 + 8.5 + 4 + 7 + 4, kNear);
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

TEST(Picture, OfALegendStandsWhereItIsPut) {
  const Box in = areaOf(plain());
  const auto sampleAt = [](LegendPlace place) { return Picture(figureOf(withLegend(place))).find(kRed); };
  const Box topLeft = sampleAt(LegendPlace::TopLeft), bottomLeft = sampleAt(LegendPlace::BottomLeft),
            topRight = sampleAt(LegendPlace::TopRight), bottomRight = sampleAt(LegendPlace::BottomRight);
  EXPECT_NEAR(topLeft.width(), 20, kNear);
  EXPECT_NEAR(topLeft.left, in.left + 4 + 4, kNear);
  EXPECT_NEAR(topLeft.y(), in.top + 2 + 4 + 6 - 0.33 * 7, kNear);
  EXPECT_NEAR(bottomLeft.left, topLeft.left, kNear);
  // It is as high as a line of 10.5 pt and 6 pt around it, and 2 pt from the border.
  EXPECT_NEAR(bottomLeft.y() - topLeft.y(), kHigh - 16.5 - 4, kNear);
  EXPECT_NEAR(topRight.y(), topLeft.y(), kNear);
  EXPECT_NEAR(bottomRight.y(), bottomLeft.y(), kNear);
  EXPECT_NEAR(bottomRight.left, topRight.left, kNear);
  // 20 of the sample, 3, the word, 4 on either side.
  Panel word = plain();
  word.words = {{7, 1.5, "HHHHHHHHHHHHHHHHHHHH", kRed}};
  const double letters = (Picture(figureOf(word)).find(kRed).width() + 1) / 10;  // of two, with their margins
  EXPECT_NEAR(topRight.left, in.right - (20 + 3 + letters + 8) + 4, 0.6);
  EXPECT_TRUE(sampleAt(LegendPlace::None).empty());
  const Box right = sampleAt(LegendPlace::Right), below = sampleAt(LegendPlace::Below);
  EXPECT_NEAR(right.left, in.right + 6 + 4, kNear);
  EXPECT_NEAR(right.y(), topLeft.y(), kNear);
  EXPECT_NEAR(below.left, in.x() - (20 + 3 + letters + 8) / 2 + 4, 0.6);
  EXPECT_NEAR(below.y(), in.bottom + 3 + 3 + 7 + 2 + 4 + 6 - 0.33 * 7, kNear);
  const auto sizeOf = [](LegendPlace place) { return Picture(figureOf(withLegend(place))); };
  EXPECT_NEAR(sizeOf(LegendPlace::Below).height() - sizeOf(LegendPlace::None).height(), 16.5 + 2, kNear);
  EXPECT_NEAR(sizeOf(LegendPlace::Right).width() - sizeOf(LegendPlace::None).width(), 20 + 3 + letters + 8 + 4, 0.6);
}

TEST(Picture, OfALegendHasALineForEachAndSamplesAsTheyAreDrawn) {
  Panel panel = withLegend(LegendPlace::TopLeft);
  Band band;
  band.label = "H", band.color = kGreen;
  panel.bands = {band};
  Series faded = line({}, {}, {0, 0, 1, 0.1});
  faded.label = "H";
  panel.series.push_back(faded);
  Series marked = points({}, {}, kPink, Marker::Square, 10);
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

TEST(Picture, OfALegendBelowStandsInColumns) {
  Panel panel = plain();
  panel.legend = LegendPlace::Below;
  const Color colors[] = {kRed, kBlue, kPink, {0, 0.5, 0}, {0.5, 0, 0}};
  for (const Color& color : colors) {
    Series s = line({}, {}, color);
    s.label = "HHHH";
    panel.series.push_back(s);
  }
  const Picture picture(figureOf(panel));
  std::vector<Box> samples;
  for (const Color& color : colors) samples.push_back(picture.find(color));
  // A column takes 23 pt and the word of some 21, with 8 between: four fit into 240 pt.
  EXPECT_NEAR(samples[0].y(), samples[3].y(), kNear);
  EXPECT_NEAR(samples[4].y() - samples[0].y(), 10.5, kNear);
  EXPECT_NEAR(samples[4].left, samples[0].left, kNear);
  const double apart = samples[1].left - samples[0].left;
  EXPECT_NEAR(samples[3].left - samples[0].left, 3 * apart, kNear);
  EXPECT_GT(apart, 23 + 8 + 18);
  EXPECT_LT(apart, 23 + 8 + 24);
}

TEST(Picture, OfAMarkedSeriesLeavesRoomForItsMarkers) {
  Panel panel;
  panel.series = {points({0, 100}, {0, 100}, kRed)};
  const auto shareOf = [](const Panel& p) {
    const Picture picture(figureOf(p));
    return picture.find(kRed).width() / kWide;
  };
  // 4 % at either end, and up to the quarter of a tick: 0 to 100 is drawn from -5 to 105.
  EXPECT_NEAR(shareOf(panel), (100.0 / 110) + 0.88 * 6 / kWide, 0.005);
  panel.series[0].marker = Marker::None, panel.series[0].width = 2;
  EXPECT_NEAR(shareOf(panel), 1, 0.015);
}

// Two columns: margins of a column and of a row are shared, 10 pt lie between.
TEST(Picture, OfPanelsStandsInRowsAndColumns) {
  Panel panels[3] = {plain(), plain(), plain()};
  const Color colors[] = {kRed, kBlue, kPink};
  for (int i = 0; i < 3; ++i) panels[i].bands = {area(colors[i])}, panels[i].x.ticks = panels[i].y.ticks = {{100, "none"}};
  panels[0].x.label = "H", panels[2].y.label = "H", panels[1].title = "H";
  Figure figure = figureOf(panels[0]);
  figure.panels = {panels[0], panels[1], panels[2]};
  figure.columns = 2;
  const Picture picture(figure);
  const Box first = picture.find(kRed), second = picture.find(kBlue), third = picture.find(kPink);
  EXPECT_NEAR(first.left, 4 + 3 + 3 + 13, kNear) << "room for the name below it";
  EXPECT_NEAR(third.left, first.left, kNear);
  EXPECT_NEAR(first.top, 4 + 15.5, kNear) << "room for the title beside it";
  EXPECT_NEAR(second.top, first.top, kNear);
  EXPECT_NEAR(second.left - first.right, 4 + 10 + 6, kNear);
  EXPECT_NEAR(third.top - first.bottom, 6 + 7 + 12 + 10 + 4, kNear);
  EXPECT_NEAR(picture.width(), second.right + 4 + 4, kNear);
  EXPECT_NEAR(picture.height(), third.bottom + 13 + 4, kNear);
  figure.title = "H";
  const Picture titled(figure);
  EXPECT_NEAR(titled.height() - picture.height(), 16, kNear);
  const Box title = titled.find({0, 0, 0}, {0, 0, 100, 16});
  EXPECT_NEAR(title.bottom, 4 + 10, kNear);
  EXPECT_NEAR(title.height(), 7.3, 0.4);
  EXPECT_NEAR(title.left, 4, 1.2);
  figure.columns = 0;
  EXPECT_NEAR(Picture(figure).find(kBlue).left, Picture(figure).find(kRed).left, kNear) << "one column at least";
}

// Bands, rules and a word are something to show, even without a title and a series.
TEST(Picture, OfAPanelIsDrawnWhateverItHas) {
  Panel band = plain(), rule = plain(), word = plain(), series = plain(), title = plain();
  for (Panel* panel : {&band, &rule, &series, &title}) panel->words.clear();
  band.bands = {area(kRed)};
  rule.rules = {{5, true, "", kRed}};
  word.words = {{5, 2, "H", kRed}};
  series.series = {line({3, 4}, {1, 1}, kRed)};
  title.title = "H";
  for (const Panel& panel : {band, rule, word, series, title}) EXPECT_FALSE(Picture(figureOf(panel)).find(kInk).empty());
  Panel nothing = plain();
  nothing.words.clear();
  EXPECT_TRUE(Picture(figureOf(nothing)).find(kInk).empty());
}

TEST(Picture, HasAsManyDotsAsAskedFor) {
  const auto widthAt = [](const std::string& png) {
    unsigned value = 0;
    for (std::size_t i = 16; i < 20; ++i) value = 256 * value + static_cast<unsigned char>(png[i]);
    return value;
  };
  const Figure figure = figureOf(plain());
  const std::string svg = renderSvg(figure);
  const double points = std::stod(svg.substr(svg.find("width=\"") + 7));
  EXPECT_EQ(widthAt(renderPng(figure)), static_cast<unsigned>(points * 150 / 72 + 0.999));
  EXPECT_EQ(widthAt(renderPng(figure, 300)), static_cast<unsigned>(points * 300 / 72 + 0.999));
}

// Okabe and Ito 2008: their colours of 0 to 255.
TEST(Palette, IsOkabesAndItos) {
  const std::pair<Color, std::array<double, 3>> known[] = {{palette::kBlack, {0, 0, 0}},        {palette::kOrange, {230, 159, 0}},
                                                           {palette::kSky, {86, 180, 233}},     {palette::kGreen, {0, 158, 115}},
                                                           {palette::kYellow, {240, 228, 66}},  {palette::kBlue, {0, 114, 178}},
                                                           {palette::kVermilion, {213, 94, 0}}, {palette::kPurple, {204, 121, 167}}};
  for (const auto& [color, rgb] : known) {
    EXPECT_NEAR(color.red * 255, rgb[0], 0.5);
    EXPECT_NEAR(color.green * 255, rgb[1], 0.5);
    EXPECT_NEAR(color.blue * 255, rgb[2], 0.5);
    EXPECT_EQ(color.alpha, 1);
  }
  EXPECT_TRUE(palette::kGrey.red == 0.45 && palette::kGrey.green == 0.45 && palette::kGrey.blue == 0.45);
  const Color faded = palette::faded(palette::kBlue, 0.3);
  EXPECT_TRUE(faded.blue == palette::kBlue.blue && faded.green == palette::kBlue.green && faded.red == 0 && faded.alpha == 0.3);
}

TEST(Palette, RepeatsAfterSevenColoursAndFiveMarkers) {
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(palette::series(i + 7).red, palette::series(i).red);
    for (int k = 0; k < i; ++k)
      EXPECT_FALSE(palette::series(i).blue == palette::series(k).blue && palette::series(i).red == palette::series(k).red);
  }
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(markerOf(i + 5), markerOf(i));
    EXPECT_NE(markerOf(i), Marker::None);
    for (int k = 0; k < i; ++k) EXPECT_NE(markerOf(i), markerOf(k));
  }
}

TEST(Figure, HasItsUsualLooks) {
  const Series series;
  EXPECT_TRUE(series.width == 1 && series.markerSize == 4 && series.marker == Marker::None && series.dash == Dash::Solid);
  EXPECT_TRUE(kThin == 0.45 && kNormal == 1 && kThick == 2);
  const Rule rule;
  EXPECT_TRUE(rule.at == 0 && rule.vertical && rule.dash == Dash::Dotted && rule.color.red == 0.45);
  const Word word;
  EXPECT_TRUE(word.x == 0 && word.y == 0 && word.color.red == 0);
  const Band band;
  EXPECT_TRUE(band.color.red == 0.45 && band.color.green == 0.45 && band.color.blue == 0.45 && band.color.alpha == 0.25);
  const Panel panel;
  EXPECT_TRUE(panel.legend == LegendPlace::Auto && panel.x.scale == Scale::Linear);
  const Color color;
  EXPECT_TRUE(color.red == 0 && color.green == 0 && color.blue == 0 && color.alpha == 1);
}

}  // namespace
}  // namespace reachlab::figure
