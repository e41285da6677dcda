#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "constraints/constraint_spec.h"
#include "gui/scene/camera.h"

namespace reachlab::gui::scene {

/// A pixel of a picture of that size, seen by that camera.
struct PixelSeen {
  Camera camera;
  double x = 0, y = 0;           // y down
  double width = 1, height = 1;  // [pixels]
};

/// The point of a constraint that is drawn at the pixel, as its parameters (metres if free). Where several points are drawn there, it is the
/// point nearest to the viewer. If no point is drawn there, it is the point drawn nearest to the pixel. `drawn` is the range of the parameters that are
/// drawn. A periodic parameter continues from `about`, which is where the place was before. Without a constraint, the point lies in the
/// plane through `about` that faces the viewer. The numbers have no more digits than the picture shows. nullopt if nothing is seen.
std::optional<std::vector<double>> placeUnder(const PixelSeen& pixel, const constraints::Constraint& constraint,
                                              const std::array<constraints::Domain, 2>& drawn, std::span<const double> about);

}  // namespace reachlab::gui::scene
