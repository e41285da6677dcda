#include "bench/scene_hand.h"

#include <cmath>

namespace reachlab::bench {
namespace {

constexpr int kTerms = dynamics::HandSegment::kMaxDegree + 2;  // one more than the position keeps, for the velocity
using Series = std::array<double, kTerms>;

// mj((t0 + s dt)/T) in powers of s: the derivatives of 10 p^3 - 15 p^4 + 6 p^5 at p0 over the factorials.
Series minimumJerkSeries(double t0, double dt, double duration) {
  const double p = t0 / duration, h = dt / duration;
  const double derivative[6] = {
      minimumJerk(p), minimumJerkRate(p), minimumJerkAcceleration(p), 60 - 360 * p + 360 * p * p, 720 * p - 360, 720};
  Series s{};
  double scale = 1;
  for (int k = 0; k < 6; ++k) {
    s[k] = derivative[k] * scale;
    scale *= h / (k + 1);
  }
  return s;
}

// sin and cos of a series by S' = C a', C' = -S a'.
void sineCosineSeries(const Series& a, Series& sine, Series& cosine) {
  sine[0] = std::sin(a[0]), cosine[0] = std::cos(a[0]);
  for (int k = 1; k < kTerms; ++k) {
    double s = 0, c = 0;
    for (int j = 1; j <= k; ++j) {
      s += j * a[j] * cosine[k - j];
      c -= j * a[j] * sine[k - j];
    }
    sine[k] = s / k, cosine[k] = c / k;
  }
}

}  // namespace

dynamics::HandSegment makeSegment(const SceneHand& law, double t0, double dt) {
  const Series q = minimumJerkSeries(t0, dt, law.duration);
  std::array<Series, 3> r{};
  if (law.kind == SceneHand::Kind::None || law.kind == SceneHand::Kind::Straight) {
    for (int k = 0; k < kTerms; ++k) r[0][k] = law.by.x * q[k], r[1][k] = law.by.y * q[k], r[2][k] = law.by.z * q[k];
    r[0][0] += law.from.x, r[1][0] += law.from.y, r[2][0] += law.from.z;
  } else {
    Series angle{}, angle4{}, s{}, c{}, s4{}, c4{};
    for (int k = 0; k < kTerms; ++k) angle[k] = law.sweep * q[k];
    angle[0] += law.phi0;
    for (int k = 0; k < kTerms; ++k) angle4[k] = 4 * angle[k];
    sineCosineSeries(angle, s, c);
    sineCosineSeries(angle4, s4, c4);
    for (int k = 0; k < kTerms; ++k) {
      if (law.kind == SceneHand::Kind::Ellipse) {
        r[1][k] = law.ellipse.a * c[k], r[2][k] = law.ellipse.b * s[k];
      } else {
        r[0][k] = law.epitrochoid.bigR * c[k] - law.epitrochoid.small * c4[k];
        r[1][k] = law.epitrochoid.bigR * s[k] - law.epitrochoid.small * s4[k];
      }
    }
  }
  dynamics::HandSegment segment;
  constexpr double kNegligiblePosition = 1e-18, kNegligibleVelocity = 1e-16;  // [m], [m/s]: below rounding of 0.1
  for (int k = 0; k <= dynamics::HandSegment::kMaxDegree; ++k) {
    segment.position[k] = {r[0][k], r[1][k], r[2][k]};
    segment.velocity[k] = ((k + 1) / dt) * Vec3{r[0][k + 1], r[1][k + 1], r[2][k + 1]};
    if (norm(segment.position[k]) > kNegligiblePosition || norm(segment.velocity[k]) > kNegligibleVelocity) segment.degree = k;
  }
  return segment;
}

dynamics::HandSample makeSample(const SceneHand& law, double t) {
  double r[3], v[3];
  evaluate(law, t, r, v);
  return {{r[0], r[1], r[2]}, {v[0], v[1], v[2]}, true};
}

}  // namespace reachlab::bench
