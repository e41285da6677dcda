#include <cmath>

#include "base/ticks.h"
#include "bench/visit_system.h"
#include "tests/bench/limit_forms.h"

namespace reachlab::bench {
namespace {

/// Two oscillators under one hand, RK4 at 1 ms.
struct ParallelForm {
  static constexpr int kStates = 4, kMasses = 2, kRhsPerStep = 4;
  double w1, w2, x0;  // k/m
  double y[4]{};

  void step(const dynamics::HandSegment& hand) {
    constexpr double h = kTickSeconds;
    const auto& p = hand.position;
    const double begin = p[0].x - x0;
    const double middle = begin + 0.5 * (p[1].x + 0.5 * (p[2].x + 0.5 * (p[3].x + 0.5 * (p[4].x + 0.5 * p[5].x))));
    const double end = begin + (p[1].x + p[2].x) + (p[3].x + p[4].x + p[5].x);
    for (int i = 0; i < 2; ++i) {
      const double w = i == 0 ? w1 : w2, x = y[i], v = y[2 + i];
      const double a1 = w * (begin - x), x2 = x + h / 2 * v, v2 = v + h / 2 * a1;
      const double a2 = w * (middle - x2), x3 = x + h / 2 * v2, v3 = v + h / 2 * a2;
      const double a3 = w * (middle - x3), x4 = x + h * v3, v4 = v + h * a3;
      const double a4 = w * (end - x4);
      y[i] = x + h / 6 * (v + 2 * (v2 + v3) + v4);
      y[2 + i] = v + h / 6 * (a1 + 2 * (a2 + a3) + a4);
    }
  }
  double probe() const { return y[0]; }
  void state(double* out) const {
    for (int i = 0; i < 4; ++i) out[i] = y[i];
  }
  void positions(double* r) const {
    for (int i = 0; i < 2; ++i) r[3 * i] = x0 + y[i], r[3 * i + 1] = r[3 * i + 2] = 0;
  }
};

/// Free on a sphere in world coordinates: r'' = -(v.v / R^2) r by RK4, then position and velocity put back on the sphere. v.v is taken
/// once a step, because the motion keeps it.
struct SphereForm {
  static constexpr int kStates = 6, kMasses = 1, kRhsPerStep = 4;
  double inverse;  // 1/R^2
  Vec3 r, v;

  void step(const dynamics::HandSegment&) {
    constexpr double h = kTickSeconds;
    const double w2 = -dot(v, v) * inverse;
    const Vec3 a1 = w2 * r, r2 = r + h / 2 * v, v2 = v + h / 2 * a1;
    const Vec3 a2 = w2 * r2, r3 = r + h / 2 * v2, v3 = v + h / 2 * a2;
    const Vec3 a3 = w2 * r3, r4 = r + h * v3, v4 = v + h * a3;
    const Vec3 a4 = w2 * r4;
    r += h / 6 * (v + 2.0 * (v2 + v3) + v4);
    v += h / 6 * (a1 + 2.0 * (a2 + a3) + a4);
    // One Newton step for |r| = R: the RK4 step left it by 1e-15 of itself.
    const double outside = 0.5 - 0.5 * dot(r, r) * inverse, outward = dot(v, r) * inverse;
    v -= outward * r;
    r += outside * r;
  }
  double probe() const { return r.x; }
  void state(double* out) const { out[0] = r.x, out[1] = r.y, out[2] = r.z, out[3] = v.x, out[4] = v.y, out[5] = v.z; }
  void positions(double* out) const { out[0] = r.x, out[1] = r.y, out[2] = r.z; }
};

}  // namespace

Contender makeSmallLimit(const BenchScene& scene) {
  const experiment::Object& o = scene.experiment.object;
  if (scene.name == "S6")
    return makeLimitContender(scene, ParallelForm{o.stiffness[0] / o.masses[0], o.stiffness[1] / o.masses[1], scene.hand.from.x});
  const double radius = scene.experiment.constraint.shape.at("R");
  double r[3], v[3];
  SphereShape{radius}.placeAndVelocity(scene.start[0], scene.start[1], scene.rate[0], scene.rate[1], r, v);
  return makeLimitContender(scene, SphereForm{1 / (radius * radius), {r[0], r[1], r[2]}, {v[0], v[1], v[2]}});
}

std::optional<Contender> makeLimit(const BenchScene& scene) {
  const std::string& n = scene.name;
  if (n == "S1" || n == "S7a" || n == "S7b") return makeExactLimit(scene);
  if (n == "S1b50" || n == "S1b500") return makeModalLimit(scene);
  if (n == "S2a" || n == "S2b" || n == "S3" || n == "S4" || n == "S7f" || n == "S8") return makeMultistepLimit(scene);
  if (n == "S6" || n == "S7d" || n == "S7e") return makeSmallLimit(scene);
  return std::nullopt;
}

}  // namespace reachlab::bench
