#pragma once
#include "analysis/figure/canvas.h"
#include "analysis/figure/ticks.h"

namespace reachlab::figure {

/// The space around the plotting area of a panel [pt].
struct Margins {
  double left = 0, right = 0, top = 0, bottom = 0;
};

/// One panel measured and ready to be drawn: measure all, align rows and columns, draw.
class PanelPainter {
 public:
  PanelPainter(Canvas& canvas, const Panel& panel, double width, double height);

  Margins margins() const { return margins_; }
  /// Draws with the top left corner of the plotting area at (left, top). The title is at the top of `topMargin`.
  void draw(double left, double top, double topMargin);

 private:
  struct Entry {  // of the legend
    const Series* series = nullptr;
    const Band* band = nullptr;
    const std::string& label() const { return series ? series->label : band->label; }
  };

  double xAt(double value) const;  // [pt] from the left edge of the plotting area
  double yAt(double value) const;  // [pt] from its top
  void chooseRanges();
  void chooseLegend();
  void measure();
  int pointsUnder(double x, double y, double width, double height) const;
  void drawAxes(double topMargin);
  void drawBand(const Band& band);
  void drawSeries(const Series& series);
  void drawRule(const Rule& rule);
  void drawRuleLabels();
  void drawLegend();
  void drawEntry(const Entry& entry, double x, double baseline);

  Canvas& canvas_;
  const Panel& panel_;
  double width_, height_;
  double left_ = 0, top_ = 0;
  AxisTicks x_, y_;
  Margins margins_;
  std::vector<Entry> entries_;
  LegendPlace place_ = LegendPlace::None;
  double legendWidth_ = 0, legendHeight_ = 0;
  int legendColumns_ = 1;
};

}  // namespace reachlab::figure
