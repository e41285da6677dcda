#pragma once
#include <array>
#include <span>

#include "base/math/vec3.h"
#include "gui/scene_plan/constraint_mesh.h"
#include "sim/experiment/scene_look.h"

/// The camera as a plain value, and the effect of the pointer on it. Pixels: y down, origin at the top left.
namespace reachlab::gui::scene {

using experiment::Camera;

/// Unit directions of a camera.
struct CameraAxes {
  Vec3 forward, right, up;
};
CameraAxes axesOf(const Camera& camera);

/// Looks from `direction` so that all the points, with `margin` [m] around each, are just seen.
Camera lookAtPoints(std::span<const Vec3> points, double margin, const Vec3& direction, double aspect, bool parallel = false);

/// The same, with `head` pixels at the top of a picture of that size left free.
Camera lookAtPointsBelow(double head, std::span<const Vec3> points, double margin, const Vec3& direction, double width, double height,
                         bool parallel = false);

/// Turns about the focus: `right` and `down` pixels of a picture `height` high.
void turn(Camera& camera, double right, double down, double height);
/// Moves sideways so that the plane through the focus follows the pointer.
void pan(Camera& camera, double right, double down, double height);
/// Nearer for factor > 1.
void zoom(Camera& camera, double factor);

/// Metres a pixel in the plane through `at` that faces the viewer.
double metresPerPixel(const Camera& camera, const Vec3& at, double height);
/// The world point under a pixel in the plane through `at` that faces the viewer.
Vec3 pointUnder(const Camera& camera, const Vec3& at, double x, double y, double width, double height);
/// The pixel of a world point.
std::array<double, 2> pixelOf(const Camera& camera, const Vec3& world, double width, double height);

}  // namespace reachlab::gui::scene
