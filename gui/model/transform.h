#pragma once
#include <array>
#include <cmath>

#include "base/math/vec3.h"

namespace reachlab::gui::model {

/// Maps positions of an inner frame into an outer frame: a 3 x 3 matrix and a shift. [m]
struct Transform {
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 shift;

  Vec3 direction(const Vec3& v) const { return v.x * columns[0] + v.y * columns[1] + v.z * columns[2]; }
  Vec3 operator()(const Vec3& p) const { return direction(p) + shift; }
  /// First `inner`, then this.
  Transform operator*(const Transform& inner) const {
    return {{direction(inner.columns[0]), direction(inner.columns[1]), direction(inner.columns[2])}, (*this)(inner.shift)};
  }
};

inline Transform shifted(const Vec3& by) {
  Transform t;
  t.shift = by;
  return t;
}

inline Transform scaled(const Vec3& by) {
  Transform t;
  t.columns = {Vec3{by.x, 0, 0}, Vec3{0, by.y, 0}, Vec3{0, 0, by.z}};
  return t;
}

/// About an axis of any length but zero (then no turn), by the right-hand rule. [rad]
inline Transform turned(const Vec3& about, double angle) {
  Transform t;
  const double length = norm(about);
  if (!(length > 0)) return t;
  const Vec3 a = about / length;
  for (Vec3& v : t.columns) v = std::cos(angle) * v + std::sin(angle) * cross(a, v) + ((1 - std::cos(angle)) * dot(a, v)) * a;
  return t;
}

}  // namespace reachlab::gui::model
