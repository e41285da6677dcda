#include "analysis/figure/figure.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include "analysis/figure/panel_painter.h"
#include "base/fault.h"

namespace reachlab::figure {
namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;
constexpr double kOuter = 4, kBetween = 10, kTitle = 16;  // [pt]

struct Size {
  double width = 0, height = 0;  // [pt]
};

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

/// Nothing to show, not even a title: a place in the row that stays white.
bool isEmpty(const Panel& panel) {
  return panel.title.empty() && panel.bands.empty() && panel.series.empty() && panel.rules.empty() && panel.words.empty();
}

/// Draws the figure, or with `draw` false only finds out how large it is.
Size paint(const Figure& figure, cairo_t* context, bool draw) {
  Canvas canvas(context);
  const double width = figure.panelWidth * kPointsPerMillimetre, height = figure.panelHeight * kPointsPerMillimetre;
  const std::size_t columns = static_cast<std::size_t>(std::max(1, figure.columns));
  const std::size_t rows = (figure.panels.size() + columns - 1) / columns;
  std::vector<PanelPainter> painters;
  painters.reserve(figure.panels.size());
  for (const Panel& panel : figure.panels) painters.emplace_back(canvas, panel, width, height);

  // Panels of a column share their left and right margins, those of a row their top and bottom, so that axes stand in line.
  std::vector<double> left(columns), right(columns), top(rows), bottom(rows);
  for (std::size_t i = 0; i < painters.size(); ++i) {
    const Margins m = painters[i].margins();
    left[i % columns] = std::max(left[i % columns], m.left);
    right[i % columns] = std::max(right[i % columns], m.right);
    top[i / columns] = std::max(top[i / columns], m.top);
    bottom[i / columns] = std::max(bottom[i / columns], m.bottom);
  }
  if (draw && !figure.title.empty()) {
    canvas.setColor(palette::kBlack);
    canvas.setFont(10, true);
    canvas.text(kOuter, kOuter + 10, figure.title);
  }
  Size size;
  double y = kOuter + (figure.title.empty() ? 0 : kTitle);
  for (std::size_t row = 0; row < rows; ++row) {
    double x = kOuter;
    y += top[row];
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t i = row * columns + column;
      x += left[column];
      if (i < painters.size()) {
        if (draw && !isEmpty(figure.panels[i])) painters[i].draw(x, y, top[row]);
        size.width = std::max(size.width, x + width + right[column] + kOuter);
      }
      x += width + right[column] + kBetween;
    }
    y += height + bottom[row] + (row + 1 < rows ? kBetween : 0);
  }
  size.height = y + kOuter;
  return size;
}

Size measure(const Figure& figure) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1), &cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), &cairo_destroy);
  return paint(figure, context.get(), false);
}

enum class Paper { None, White };  // a figure without it is unreadable where the page around it is dark

/// `scale`: of the surface's units in a point.
void paintOn(const Surface& surface, const Figure& figure, Paper paper, double scale = 1) {
  const Context context(cairo_create(surface.get()), &cairo_destroy);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  if (paper == Paper::White) cairo_paint(context.get());
  cairo_scale(context.get(), scale, scale);
  paint(figure, context.get(), true);
}

void finish(const Surface& surface) {
  cairo_surface_finish(surface.get());
  if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
    throw ResourceError(std::string("figure: cairo says: ") + cairo_status_to_string(status));
}

/// Cairo numbers its surfaces through the whole process; here they are numbered through the figure.
std::string withOwnNumbers(const std::string& svg) {
  static constexpr std::string_view kName = "surface";
  std::vector<std::string> seen;
  std::string out;
  std::size_t at = 0;
  for (std::size_t hit; (hit = svg.find(kName, at)) != std::string::npos;) {
    std::size_t end = hit + kName.size();
    while (end < svg.size() && svg[end] >= '0' && svg[end] <= '9') ++end;
    const std::string number = svg.substr(hit + kName.size(), end - hit - kName.size());
    auto known = std::find(seen.begin(), seen.end(), number);
    if (known == seen.end()) known = seen.insert(seen.end(), number);
    out.append(svg, at, hit - at).append(kName).append(std::to_string(known - seen.begin() + 1));
    at = end;
  }
  return out.append(svg, at);
}

std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t hit; (hit = text.find(from, at)) != std::string::npos; at = hit + from.size()) out.append(text, at, hit - at).append(to);
  return out.append(text, at);
}

}  // namespace

Color palette::series(int i) {
  // Yellow is left out: it vanishes on white paper.
  static constexpr std::array<Color, 7> kOrder{kBlue, kVermilion, kGreen, kPurple, kOrange, kSky, kBlack};
  return kOrder[static_cast<std::size_t>(i) % kOrder.size()];
}

MarkerShape markerOf(int i) {
  static constexpr std::array<MarkerShape, 5> kOrder{MarkerShape::Circle, MarkerShape::Square, MarkerShape::Triangle, MarkerShape::Diamond,
                                                     MarkerShape::Cross};
  return kOrder[static_cast<std::size_t>(i) % kOrder.size()];
}

std::string renderSvg(const Figure& figure, const std::string& idPrefix) {
  std::string bytes;
  const Size size = measure(figure);
  const Surface surface(cairo_svg_surface_create_for_stream(append, &bytes, size.width, size.height), &cairo_surface_destroy);
  paintOn(surface, figure, Paper::White);
  finish(surface);
  bytes = withOwnNumbers(bytes);
  if (idPrefix.empty()) return bytes;
  bytes = replaced(bytes, " id=\"", " id=\"" + idPrefix);
  bytes = replaced(bytes, "href=\"#", "href=\"#" + idPrefix);
  return replaced(bytes, "url(#", "url(#" + idPrefix);
}

std::string renderPdf(const Figure& figure) {
  std::string bytes;
  const Size size = measure(figure);
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, size.width, size.height), &cairo_surface_destroy);
  // Cairo would write the present time: a file that differs at each run cannot be compared.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
  paintOn(surface, figure, Paper::None);
  finish(surface);
  return bytes;
}

std::string renderPng(const Figure& figure) {
  constexpr double kPixelsPerPoint = 150.0 / 72;
  std::string bytes;
  const Size size = measure(figure);
  const auto pixels = [](double points) { return static_cast<int>(points * kPixelsPerPoint + 0.999); };
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels(size.width), pixels(size.height)), &cairo_surface_destroy);
  paintOn(surface, figure, Paper::White, kPixelsPerPoint);
  cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  finish(surface);
  return bytes;
}

std::string renderFor(const std::string& file, const Figure& figure) {
  if (file.ends_with(".svg")) return renderSvg(figure);
  if (file.ends_with(".pdf")) return renderPdf(figure);
  if (file.ends_with(".png")) return renderPng(figure);
  throw FaultError(Fault{file, "unknown kind of figure", ".svg, .pdf, .png"});
}

}  // namespace reachlab::figure
