#include <array>

#include "analysis/figure/figure.h"

namespace reachlab::figure {

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

}  // namespace reachlab::figure
