#pragma once
#include <QColor>
#include <QString>
#include <vector>

namespace reachlab::gui::plot {

/// A prediction's line. Dashes and marks tell it from others without its colour.
struct LineStyle {
  QColor colour;
  std::vector<double> dashes;  // lengths of dash and gap in turn, in widths of the line
  int mark = 0;                // index of a shape
};

/// A prediction in a plot.
struct PredictedLine {
  QString title;
  LineStyle style;
  bool fitted = false;                 // thicker, with filled marks
  std::vector<double> x = {}, y = {};  // [s], [m/s]
};

}  // namespace reachlab::gui::plot
