#pragma once
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/figure/figure.h"

/// A figure as it is seen: what is drawn in a colour of its own is found again by it, to a fifth of a point.
namespace reachlab::figure {

struct Box {
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;  // [pt]
  bool empty() const { return right < left; }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  double x() const { return (left + right) / 2; }
  double y() const { return (top + bottom) / 2; }
};

class Picture {
 public:
  static constexpr double kScale = 5;  // [pixels/pt]

  explicit Picture(const Figure& figure) {
    const std::string png = renderPng(figure, 72 * kScale);
    struct Source {
      const std::string& bytes;
      std::size_t at = 0;
    } source{png};
    const auto read = [](void* from, unsigned char* to, unsigned int length) {
      Source& s = *static_cast<Source*>(from);
      if (s.at + length > s.bytes.size()) return CAIRO_STATUS_READ_ERROR;
      std::memcpy(to, s.bytes.data() + s.at, length);
      s.at += length;
      return CAIRO_STATUS_SUCCESS;
    };
    surface_.reset(cairo_image_surface_create_from_png_stream(read, &source));
    width_ = cairo_image_surface_get_width(surface_.get());
    height_ = cairo_image_surface_get_height(surface_.get());
  }

  double width() const { return width_ / kScale; }
  double height() const { return height_ / kScale; }
  Color at(double x, double y) const { return pixel(static_cast<int>(x * kScale), static_cast<int>(y * kScale)); }
  bool isAt(double x, double y, const Color& color) const { return same(at(x, y), color); }

  /// What has the colour, within a part of the picture.
  Box find(const Color& color, const Box& within = {0, 0, 1e6, 1e6}) const {
    Box box;
    for (int y = std::max(0, static_cast<int>(within.top * kScale)); y < std::min(height_, static_cast<int>(within.bottom * kScale)); ++y)
      for (int x = std::max(0, static_cast<int>(within.left * kScale)); x < std::min(width_, static_cast<int>(within.right * kScale)); ++x)
        if (same(pixel(x, y), color)) {
          box.left = std::min(box.left, x / kScale), box.right = std::max(box.right, (x + 1) / kScale);
          box.top = std::min(box.top, y / kScale), box.bottom = std::max(box.bottom, (y + 1) / kScale);
        }
    return box;
  }
  /// The stretches of a colour along a horizontal, or vertical, line: from, to [pt].
  std::vector<std::pair<double, double>> along(bool horizontal, double at, const Color& color, double from = 0, double to = 1e6) const {
    std::vector<std::pair<double, double>> out;
    bool inside = false;
    for (int i = static_cast<int>(from * kScale); i < std::min(horizontal ? width_ : height_, static_cast<int>(to * kScale)); ++i) {
      const int across = static_cast<int>(at * kScale);
      const bool here = same(horizontal ? pixel(i, across) : pixel(across, i), color);
      if (here && !inside) out.emplace_back(i / kScale, i / kScale);
      if (here) out.back().second = (i + 1) / kScale;
      inside = here;
    }
    return out;
  }

 private:
  static bool same(const Color& a, const Color& b) {
    const double most = 0.02;
    return std::abs(a.red - b.red) < most && std::abs(a.green - b.green) < most && std::abs(a.blue - b.blue) < most;
  }
  Color pixel(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return {-1, -1, -1};
    std::uint32_t value = 0;
    std::memcpy(&value, cairo_image_surface_get_data(surface_.get()) + y * cairo_image_surface_get_stride(surface_.get()) + 4 * x, 4);
    return {((value >> 16) & 255) / 255.0, ((value >> 8) & 255) / 255.0, (value & 255) / 255.0};
  }

  struct Destroy {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  };
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
  int width_ = 0, height_ = 0;
};

}  // namespace reachlab::figure
