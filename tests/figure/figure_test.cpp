#include "analysis/figure/figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/figure/ticks.h"
#include "base/fault.h"

namespace reachlab::figure {
namespace {

Figure exampleFigure() {
  Panel velocity{.title = "(a) Hand", .x = {.label = "Time (s)"}, .y = {.label = "Velocity (m/s)"}, .rules = {{0.9, true, "T"}}};
  Series line{.label = "mean"};
  Band band{.label = "± SD"};
  for (int i = 0; i <= 50; ++i) {
    const double s = i / 50.0, v = 30 * 0.2 * s * s * (1 - s) * (1 - s);
    line.x.push_back(s), line.y.push_back(v);
    band.x.push_back(s), band.low.push_back(0.9 * v), band.high.push_back(1.1 * v);
  }
  velocity.series = {line};
  velocity.bands = {band};
  const Series points{.x = {10, 100, 1000},
                      .y = {1e-3, 1e-7, 1e-12},
                      .dash = Dash::DashDot,
                      .marker = MarkerShape::Diamond,
                      .errorLow = {5e-4, 5e-8, 5e-13},
                      .errorHigh = {2e-3, 2e-7, 2e-12}};
  const Panel precision{.x = {.scale = Scale::Log}, .y = {.scale = Scale::Log}, .series = {points}};
  return {.panels = {velocity, precision}, .columns = 2};
}

TEST(NiceTicks, OfNoIntervalAreNone) {
  EXPECT_TRUE(niceTicks(1, 1, 5).empty());
  EXPECT_TRUE(niceTicks(2, 1, 5).empty());
  EXPECT_TRUE(niceTicks(std::nan(""), 1, 5).empty());
  EXPECT_TRUE(niceTicks(0, std::numeric_limits<double>::infinity(), 5).empty());
  EXPECT_TRUE(niceTicks(0.1, std::nextafter(0.1, 1), 5).empty()) << "no step is large enough to come from one to the next";
}

TEST(Figure, IsTheSameBytesEachTime) {
  const Figure figure = exampleFigure();
  const std::string svg = renderSvg(figure), pdf = renderPdf(figure), png = renderPng(figure);
  EXPECT_EQ(svg, renderSvg(figure));
  EXPECT_EQ(pdf, renderPdf(figure));
  EXPECT_EQ(png, renderPng(figure));
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
}

TEST(Figure, IsOfTheKindItsNameSays) {
  EXPECT_NE(renderFor("a/figure.svg", exampleFigure()).find("<svg"), std::string::npos);
  EXPECT_EQ(renderFor("figure.pdf", exampleFigure()).substr(0, 5), "%PDF-");
  EXPECT_EQ(renderFor("figure.png", exampleFigure()).substr(1, 3), "PNG");
  EXPECT_THROW(renderFor("figure.bmp", exampleFigure()), FaultError);
}

TEST(Figure, PrefixesEveryIdAndReference) {
  const std::string svg = renderSvg(exampleFigure(), "f3-");
  std::size_t ids = 0;
  for (std::size_t at = 0; (at = svg.find(" id=\"", at)) != std::string::npos; ++at, ++ids) EXPECT_EQ(svg.substr(at + 5, 3), "f3-");
  EXPECT_GT(ids, 0u);
  for (std::size_t at = 0; (at = svg.find("href=\"#", at)) != std::string::npos; ++at) EXPECT_EQ(svg.substr(at + 7, 3), "f3-");
  for (std::size_t at = 0; (at = svg.find("url(#", at)) != std::string::npos; ++at) EXPECT_EQ(svg.substr(at + 5, 3), "f3-");
}

TEST(Figure, BearsHolesEmptySeriesAndHugeValues) {
  Figure figure = exampleFigure();
  Series holes;
  holes.x = {0, 0.5, 1};
  holes.y = {0.1, std::nan(""), std::numeric_limits<double>::infinity()};
  figure.panels[0].series.push_back(holes);
  figure.panels[0].series.push_back({});
  figure.panels[1].series.push_back(holes);
  figure.panels[1].y.to = 1e-6;  // points above the panel
  figure.panels.push_back({});
  const std::string svg = renderSvg(figure);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace reachlab::figure
