#include "analysis/figure/canvas.h"

#include <algorithm>
#include <numbers>

namespace reachlab::figure {

Canvas::Canvas(cairo_t* context) : context_(context) {
  // Metrics without hinting are the same on every surface, so that SVG, PDF and PNG have one layout.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context_, options);
  cairo_font_options_destroy(options);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
}

void Canvas::setColor(const Color& c) { cairo_set_source_rgba(context_, c.red, c.green, c.blue, c.alpha); }

void Canvas::setStroke(const Color& color, double width, Dash dash) {
  setColor(color);
  cairo_set_line_width(context_, width);
  const double w = std::max(width, 0.7);
  const double dashed[] = {4.5 * w, 2.5 * w}, dotted[] = {1.2 * w, 2 * w}, dashDot[] = {5 * w, 2 * w, 1.2 * w, 2 * w};
  switch (dash) {
    case Dash::Solid: cairo_set_dash(context_, nullptr, 0, 0); break;
    case Dash::Dashed: cairo_set_dash(context_, dashed, 2, 0); break;
    case Dash::Dotted: cairo_set_dash(context_, dotted, 2, 0); break;
    case Dash::DashDot: cairo_set_dash(context_, dashDot, 4, 0); break;
  }
}

void Canvas::setFont(double size, bool bold) {
  // DejaVu comes with fontconfig on a bare Debian and has Greek, superscripts and the minus sign.
  cairo_select_font_face(context_, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, size);
}

double Canvas::textWidth(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo_text_extents(context_, text.c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(double x, double y, const std::string& text, Align align) {
  const double shift = align == Align::Left ? 0 : align == Align::Centre ? textWidth(text) / 2 : textWidth(text);
  cairo_move_to(context_, x - shift, y);
  cairo_show_text(context_, text.c_str());
  cairo_new_path(context_);
}

void Canvas::textUpwards(double x, double y, const std::string& text) {
  cairo_save(context_);
  cairo_translate(context_, x, y + textWidth(text) / 2);
  cairo_rotate(context_, -std::numbers::pi / 2);
  cairo_move_to(context_, 0, 0);
  cairo_show_text(context_, text.c_str());
  cairo_restore(context_);
  cairo_new_path(context_);
}

void Canvas::line(double x0, double y0, double x1, double y1) {
  cairo_move_to(context_, x0, y0);
  cairo_line_to(context_, x1, y1);
  cairo_stroke(context_);
}

void Canvas::fillBox(double x, double y, double width, double height) {
  cairo_rectangle(context_, x, y, width, height);
  cairo_fill(context_);
}

void Canvas::marker(MarkerShape marker, double x, double y, double size, const Color& color) {
  const double r = size / 2;
  setColor(color);
  switch (marker) {
    case MarkerShape::None: return;
    case MarkerShape::Circle: cairo_arc(context_, x, y, r, 0, 2 * std::numbers::pi); break;
    case MarkerShape::Square: cairo_rectangle(context_, x - 0.88 * r, y - 0.88 * r, 1.76 * r, 1.76 * r); break;
    case MarkerShape::Triangle:
      cairo_move_to(context_, x, y - 1.15 * r);
      cairo_line_to(context_, x + r, y + 0.75 * r);
      cairo_line_to(context_, x - r, y + 0.75 * r);
      break;
    case MarkerShape::Diamond:
      cairo_move_to(context_, x, y - 1.2 * r);
      cairo_line_to(context_, x + 1.2 * r, y);
      cairo_line_to(context_, x, y + 1.2 * r);
      cairo_line_to(context_, x - 1.2 * r, y);
      break;
    case MarkerShape::Cross:
      setStroke(color, std::max(0.8, size / 4));
      line(x - r, y - r, x + r, y + r);
      line(x - r, y + r, x + r, y - r);
      return;
  }
  cairo_close_path(context_);
  cairo_fill(context_);
}

}  // namespace reachlab::figure
