#pragma once
#include "base/math/matrix.h"
#include "base/math/vec3.h"

namespace reachlab::gui::model {

/// Maps positions of an inner frame into an outer frame. [m]
using Transform = Eigen::Affine3d;

inline Vec3 mapped(const Transform& frame, const Vec3& p) {
  const Eigen::Vector3d q = frame * Eigen::Vector3d(p.x, p.y, p.z);
  return {q.x(), q.y(), q.z()};
}

inline Transform shifted(const Vec3& by) { return Transform(Eigen::Translation3d(by.x, by.y, by.z)); }
inline Transform scaled(const Vec3& by) { return Transform(Eigen::Scaling(by.x, by.y, by.z)); }

/// About an axis of any length but zero (then no turn), by the right-hand rule. [rad]
inline Transform turned(const Vec3& about, double angle) {
  const Eigen::Vector3d axis(about.x, about.y, about.z);
  return axis.squaredNorm() > 0 ? Transform(Eigen::AngleAxisd(angle, axis.normalized())) : Transform::Identity();
}

}  // namespace reachlab::gui::model
