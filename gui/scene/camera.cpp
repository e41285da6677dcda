#include "gui/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reachlab::gui::scene {
namespace {

double tanHalf(const Camera& camera) { return std::tan(camera.angle * std::numbers::pi / 360); }

Vec3 unit(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? v / length : Vec3{0, 0, 1};
}

// Rodrigues' rotation.
Vec3 rotated(const Vec3& v, const Vec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

}  // namespace

CameraAxes axesOf(const Camera& camera) {
  CameraAxes axes;
  axes.forward = unit(camera.focus - camera.position);
  Vec3 right = cross(axes.forward, camera.up);
  if (norm(right) < 1e-9) right = cross(axes.forward, Vec3{0, 0, 1});  // straight from above
  if (norm(right) < 1e-9) right = {1, 0, 0};
  axes.right = unit(right);
  axes.up = cross(axes.right, axes.forward);
  return axes;
}

Camera lookAtPoints(std::span<const Vec3> points, double margin, const Vec3& direction, double aspect, bool parallel) {
  Box box;
  for (const Vec3& p : points) box.add(p);
  Camera camera;
  camera.parallel = parallel;
  camera.focus = box.valid() ? box.centre() : Vec3{};
  camera.position = camera.focus + unit(direction);
  camera.up = axesOf(camera).up;
  // The middle of what is seen, across and up, is the middle of the picture; then as near as the worst point allows.
  const CameraAxes axes = axesOf(camera);
  Box seen;
  seen.add({});
  for (const Vec3& p : points) seen.add({dot(p - camera.focus, axes.right), dot(p - camera.focus, axes.up), 0});
  camera.focus += seen.centre().x * axes.right + seen.centre().y * axes.up;
  double distance = 1e-6;
  for (const Vec3& p : points) {
    const Vec3 arm = p - camera.focus;
    const double across = (std::abs(dot(arm, axes.right)) + margin) / aspect, up = std::abs(dot(arm, axes.up)) + margin;
    distance = std::max(distance, std::max(across, up) / tanHalf(camera) - (parallel ? 0 : dot(arm, axes.forward)));
  }
  camera.position = camera.focus - distance * axes.forward;
  return camera;
}

Camera lookAtPointsBelow(double head, std::span<const Vec3> points, double margin, const Vec3& direction, double width, double height,
                         bool parallel) {
  const double free = std::max(height - head, 0.5 * height);
  Camera camera = lookAtPoints(points, margin, direction, width / free, parallel);
  // Back until the free part is as large as the picture was, then up, so that what is seen comes down.
  camera.position = camera.focus + (height / free) * (camera.position - camera.focus);
  pan(camera, 0, 0.5 * (height - free), height);
  return camera;
}

void turn(Camera& camera, double right, double down, double height) {
  const double scale = std::numbers::pi / std::max(height, 1.0);  // half a turn over the picture's height
  CameraAxes axes = axesOf(camera);
  Vec3 arm = camera.position - camera.focus;
  arm = rotated(arm, axes.up, -right * scale);
  camera.position = camera.focus + arm;
  camera.up = axes.up;
  axes = axesOf(camera);
  arm = rotated(arm, axes.right, -down * scale);
  camera.up = rotated(axes.up, axes.right, -down * scale);
  camera.position = camera.focus + arm;
}

void pan(Camera& camera, double right, double down, double height) {
  const CameraAxes axes = axesOf(camera);
  const double scale = metresPerPixel(camera, camera.focus, height);
  const Vec3 shift = (-right * scale) * axes.right + (down * scale) * axes.up;
  camera.position += shift;
  camera.focus += shift;
}

void zoom(Camera& camera, double factor) {
  if (!(factor > 0)) return;
  camera.position = camera.focus + (camera.position - camera.focus) / std::clamp(factor, 0.2, 5.0);
}

double metresPerPixel(const Camera& camera, const Vec3& at, double height) {
  const double depth = camera.parallel ? norm(camera.focus - camera.position) : dot(at - camera.position, axesOf(camera).forward);
  return 2 * std::max(depth, 1e-6) * tanHalf(camera) / std::max(height, 1.0);
}

Vec3 pointUnder(const Camera& camera, const Vec3& at, double x, double y, double width, double height) {
  const CameraAxes axes = axesOf(camera);
  const double depth = std::max(dot(at - camera.position, axes.forward), 1e-6), scale = metresPerPixel(camera, at, height);
  return camera.position + depth * axes.forward + ((x - 0.5 * width) * scale) * axes.right + ((0.5 * height - y) * scale) * axes.up;
}

std::array<double, 2> pixelOf(const Camera& camera, const Vec3& world, double width, double height) {
  const CameraAxes axes = axesOf(camera);
  const double scale = metresPerPixel(camera, world, height);
  const Vec3 arm = world - camera.position;
  return {0.5 * width + dot(arm, axes.right) / scale, 0.5 * height - dot(arm, axes.up) / scale};
}

}  // namespace reachlab::gui::scene
