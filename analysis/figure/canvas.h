#pragma once
#include <cairo.h>

#include <string>

#include "analysis/figure/figure.h"

namespace reachlab::figure {

enum class Align { Left, Centre, Right };

/// Cairo in our words. Lengths in points, origin top left, y down. Borrows the context.
class Canvas {
 public:
  explicit Canvas(cairo_t* context);

  void setColor(const Color& color);
  void setStroke(const Color& color, double width, Dash dash = Dash::Solid);
  void setFont(double size, bool bold = false);

  double textWidth(const std::string& text) const;
  /// `y` is the baseline.
  void text(double x, double y, const std::string& text, Align align = Align::Left);
  /// Reads upwards. `x` is the baseline, `y` the middle of the text.
  void textUpwards(double x, double y, const std::string& text);

  void line(double x0, double y0, double x1, double y1);
  void fillBox(double x, double y, double width, double height);
  void marker(MarkerShape marker, double x, double y, double size, const Color& color);

  cairo_t* context() const { return context_; }

 private:
  cairo_t* context_;
};

}  // namespace reachlab::figure
