#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Paints the figures of the report and for print. A description becomes SVG, PDF or PNG. The same values give the same bytes, without
/// dates or counters. Any thread. Nothing here depends on the plotted quantity.
namespace reachlab::figure {

/// sRGB with opacity, each 0 … 1.
struct Color {
  double red = 0, green = 0, blue = 0, alpha = 1;
};

/// Colours that stay apart for colour-blind readers (Okabe and Ito 2008) and, where it matters, in grey print.
namespace palette {
inline constexpr Color kBlack{0.0, 0.0, 0.0}, kGrey{0.45, 0.45, 0.45}, kOrange{0.902, 0.624, 0.0}, kSky{0.337, 0.706, 0.914},
    kGreen{0.0, 0.620, 0.451}, kBlue{0.0, 0.447, 0.698}, kVermilion{0.835, 0.369, 0.0}, kPurple{0.800, 0.475, 0.655};
/// The i-th colour for series of equal standing. The colours repeat after seven.
Color series(int i);
constexpr Color faded(Color c, double alpha) { return {c.red, c.green, c.blue, alpha}; }
}  // namespace palette

enum class Dash { Solid, Dashed, Dotted, DashDot };
enum class MarkerShape { None, Circle, Square, Triangle, Diamond, Cross };
/// The i-th marker for series of equal standing. It is always visible.
MarkerShape markerOf(int i);

/// Usual widths: a trial among many, an ordinary line, the most important line.
inline constexpr double kThin = 0.45, kNormal = 1.0, kThick = 2.0;  // [pt]

/// A line, points, or both. Gaps are where x or y is not finite (or not positive on a logarithmic axis).
struct Series {
  std::string label = {};              // empty: not in the legend
  std::vector<double> x = {}, y = {};  // same length, in the axes' units
  Color color = palette::kBlack;
  double width = kNormal;  // [pt]; 0: no line
  Dash dash = Dash::Solid;
  MarkerShape marker = MarkerShape::None;
  double markerSize = 4;                              // [pt] diameter
  std::vector<double> errorLow = {}, errorHigh = {};  // vertical error bars from … to, in y's units; empty: none
};

/// An area between two curves: mean ± SD, an interval. Drawn below all lines.
struct Band {
  std::string label = {};
  std::vector<double> x = {}, low = {}, high = {};
  Color color{0.45, 0.45, 0.45, 0.25};
};

/// A thin line across the whole panel at one value, with a word at its end: a limit, a target, the end of a movement.
struct Rule {
  double at = 0;
  bool vertical = true;  // at x = at; else at y = at
  std::string label = {};
  Color color = palette::kGrey;
  Dash dash = Dash::Dotted;
};

/// A word in a panel, centred on a place: the number of a cell.
struct Word {
  double x = 0, y = 0;  // in the axes' units
  std::string text;
  Color color = palette::kBlack;
};

enum class Scale { Linear, Log };

struct Axis {
  std::string label = {};  // with its unit: "Hand velocity (m/s)"
  Scale scale = Scale::Linear;
  std::optional<double> from = {}, to = {};                // nullopt: from the data, rounded to ticks
  std::vector<std::pair<double, std::string>> ticks = {};  // named places, e.g. categories; empty: chosen
};

enum class LegendPlace { Auto, TopLeft, TopRight, BottomLeft, BottomRight, Below, Right, None };

/// One pair of axes.
struct Panel {
  std::string title = {};
  Axis x = {}, y = {};
  std::vector<Band> bands = {};
  std::vector<Series> series = {};  // drawn in order: later ones on top
  std::vector<Rule> rules = {};
  std::vector<Word> words = {};            // on top of everything
  LegendPlace legend = LegendPlace::Auto;  // Auto: the corner with the fewest data
};

/// Panels in rows of `columns` (an empty one leaves its place white), each `panelWidth` by `panelHeight` of plotting area.
struct Figure {
  std::string title = {};  // above everything; usually empty: a caption says it
  std::vector<Panel> panels = {};
  int columns = 1;
  double panelWidth = 75, panelHeight = 50;  // [mm] between the axes
};

/// `idPrefix` keeps the ids of several SVGs apart when they are put into one HTML page.
std::string renderSvg(const Figure& figure, const std::string& idPrefix = "");
std::string renderPdf(const Figure& figure);
/// A white page at 150 dots per inch.
std::string renderPng(const Figure& figure);

/// The content of FILE.svg, FILE.pdf or FILE.png, as the ending says. Throws FaultError for another ending.
std::string renderFor(const std::string& file, const Figure& figure);

/// Round numbers within [from, to] that divide it into about `wanted` parts. Steps are 1, 2 or 5 times a power of ten. Empty unless
/// from < to and both are finite.
std::vector<double> niceTicks(double from, double to, int wanted);
/// A tick as text, with the fewest digits that tell neighbours `step` apart. The minus sign is U+2212.
std::string tickText(double value, double step);

}  // namespace reachlab::figure
