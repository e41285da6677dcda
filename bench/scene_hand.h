#pragma once
#include "base/math/minimum_jerk.h"
#include "base/math/vec3.h"
#include "bench/systems.h"
#include "sim/dynamics/hand/hand_segment.h"

namespace reachlab::bench {

/// The hand of a scene as a function of time. It is a minimum jerk from 0 to 1 over `duration`, along a chord or along the parameter of a
/// curve.
struct SceneHand {
  enum class Kind { None, Straight, Ellipse, Epitrochoid };
  Kind kind = Kind::None;
  double duration = 1;         // [s] T
  Vec3 from, by;               // [m] Straight: from + by mj(t/T)
  double phi0 = 0, sweep = 0;  // curves: r(phi0 + sweep mj(t/T))
  EllipseShape ellipse{};
  EpitrochoidShape epitrochoid{};
};

/// Position [m] and velocity [m/s] at 0 <= t <= T, exact in the arithmetic of T.
template <class T>
void evaluate(const SceneHand& law, const T& t, T* r, T* v) {
  const T p = t / law.duration;
  const T q = minimumJerk(p);
  const T rate = minimumJerkRate(p) / law.duration;
  const double from[3] = {law.from.x, law.from.y, law.from.z}, by[3] = {law.by.x, law.by.y, law.by.z};
  if (law.kind == SceneHand::Kind::None || law.kind == SceneHand::Kind::Straight) {
    for (int i = 0; i < 3; ++i) r[i] = from[i] + by[i] * q, v[i] = by[i] * rate;
    return;
  }
  const T phi = law.phi0 + law.sweep * q;
  T d[3], dd[3];
  if (law.kind == SceneHand::Kind::Ellipse) law.ellipse.evaluate(phi, r, d, dd);
  else law.epitrochoid.evaluate(phi, r, d, dd);
  for (int i = 0; i < 3; ++i) v[i] = d[i] * (law.sweep * rate);
}

/// The law over [t0, t0 + dt] within [0, T] as the polynomial that drives a plant. It is the Taylor series, cut where the rest is below
/// rounding. Degree 5 is exact for a chord.
dynamics::HandSegment makeSegment(const SceneHand& law, double t0, double dt);

dynamics::HandSample makeSample(const SceneHand& law, double t);

}  // namespace reachlab::bench
