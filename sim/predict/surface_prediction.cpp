#include "sim/predict/surface_prediction.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/predict/jet.h"
#include "sim/predict/transcription.h"

namespace reachlab::predict {
namespace {

// Central differences on nine points, eighth order for the first and second derivative, sixth for the third (which only shapes
// the Newton matrix). [derivative][offset + 4]
constexpr double kDifference[4][9] = {{0, 0, 0, 0, 1, 0, 0, 0, 0},
                                      {1.0 / 280, -4.0 / 105, 1.0 / 5, -4.0 / 5, 0, 4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280},
                                      {-1.0 / 560, 8.0 / 315, -1.0 / 5, 8.0 / 5, -205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560},
                                      {-7.0 / 240, 3.0 / 10, -169.0 / 120, 61.0 / 30, 0, -61.0 / 30, 169.0 / 120, -3.0 / 10, 7.0 / 240}};
constexpr double kStep = 0.02;  // of the parameter's natural scale, 1 for angles: truncation and rounding both near 1e-12

double component(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

// All partial derivatives d[a][b] = r_(u^a v^b), a + b <= `order`, which is 3 or 5.
using SurfaceExpansion = std::array<std::array<Vec3, 6>, 6>;
SurfaceExpansion expandSurface(const constraints::Surface& surface, double u, double v, const std::array<double, 2>& step, int order) {
  SurfaceExpansion d{};
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < 9; ++j) {
      if (order == 3 && i != 4 && j != 4) continue;  // first derivatives need no corners
      const constraints::SurfacePoint p = constraints::evaluate(surface, u + (i - 4) * step[0], v + (j - 4) * step[1]);
      if (i == 4 && j == 4) d[0][0] = p.r, d[1][0] = p.rU, d[0][1] = p.rV, d[1][1] = p.rUv;
      double scaleU = 1;
      for (int a = 0; a <= order - 2; ++a, scaleU /= step[0]) {
        double factor = kDifference[a][i] * scaleU;
        if (factor == 0) continue;
        for (int b = 0; a + b <= order - 2; ++b, factor /= step[1]) {
          const double weight = factor * kDifference[b][j];
          d[a + 2][b] += weight * p.rUu;
          if (a < 2) d[a][b + 2] += weight * p.rVv;
        }
      }
    }
  return d;
}

template <int Locals>
void store(const std::array<Jet<Locals>, 3>& jerk, double* r, double* ra, double* raa) {
  for (int k = 0; k < 3; ++k) jerk[k].store(r + k, ra + k * Locals, raa + k * Locals * Locals);
}

double stepFor(const constraints::Domain& domain) {
  const double width = domain.hi - domain.lo;
  return std::isfinite(width) ? kStep * std::min(1.0, width) : kStep;
}

}  // namespace

std::unique_ptr<Prediction> makeSurfaceJerkPrediction(const constraints::Constraint& surface, const std::vector<double>& start,
                                                      const std::vector<double>& target, double duration, int massCount, int unknowns) {
  constexpr int kLocals = 8;
  TranscribedProblem problem;
  problem.duration = duration;
  problem.locals = kLocals;
  problem.residuals = 3;
  problem.from = start;
  problem.to = target;
  for (int motion = 0; motion < 2; ++motion) {
    std::vector<double> local(kLocals * 4, 0.0);
    for (int m = 0; m < 4; ++m) local[(motion * 4 + m) * 4 + m] = 1;
    problem.local.push_back(local);
  }
  const std::array<double, 2> step{stepFor(surface.domain[0]), stepFor(surface.domain[1])};
  problem.residual = [&](const double* a, double* r, double* ra, double* raa) {
    using S = Jet<kLocals>;
    const SurfaceExpansion d = expandSurface(surface.surface, a[0], a[4], step, ra == nullptr ? 3 : 5);
    if (ra == nullptr) {
      const double u = a[1], v = a[5];
      const Vec3 plain = u * u * u * d[3][0] + 3 * u * u * v * d[2][1] + 3 * u * v * v * d[1][2] + v * v * v * d[0][3] +
                         3 * u * a[2] * d[2][0] + 3 * (u * a[6] + a[2] * v) * d[1][1] + 3 * v * a[6] * d[0][2] + a[3] * d[1][0] +
                         a[7] * d[0][1];
      r[0] = plain.x, r[1] = plain.y, r[2] = plain.z;
      return;
    }
    const S u1 = S::variable(1, a[1]), u2 = S::variable(2, a[2]), u3 = S::variable(3, a[3]);
    const S v1 = S::variable(5, a[5]), v2 = S::variable(6, a[6]), v3 = S::variable(7, a[7]);
    const S uuu = u1 * u1 * u1, uuv = 3.0 * u1 * u1 * v1, uvv = 3.0 * u1 * v1 * v1, vvv = v1 * v1 * v1;
    const S uu = 3.0 * u1 * u2, uv = 3.0 * (u1 * v2 + u2 * v1), vv = 3.0 * v1 * v2;
    std::array<S, 3> jerk;
    for (int k = 0; k < 3; ++k) {
      const auto partial = [&](int i, int j) {
        S c(component(d[i][j], k));
        c.slope[0] = component(d[i + 1][j], k);
        c.slope[4] = component(d[i][j + 1], k);
        c.bend[0] = component(d[i + 2][j], k);
        c.bend[4] = c.bend[4 * kLocals] = component(d[i + 1][j + 1], k);
        c.bend[4 * kLocals + 4] = component(d[i][j + 2], k);
        return c;
      };
      jerk[k] = partial(3, 0) * uuu + partial(2, 1) * uuv + partial(1, 2) * uvv + partial(0, 3) * vvv + partial(2, 0) * uu +
                partial(1, 1) * uv + partial(0, 2) * vv + partial(1, 0) * u3 + partial(0, 1) * v3;
    }
    store<kLocals>(jerk, r, ra, raa);
  };
  const TranscribedMotion motion = solveFromStarts(problem, unknowns);
  const LegendreSeries u = motion.derivative(0, 0), v = motion.derivative(1, 0), du = motion.derivative(0, 1), dv = motion.derivative(1, 1);
  // Arc length along the motion from its speed.
  const GaussRule<double> rule = makeGaussRule<double>(3 * motion.basis.columns() + 40);
  std::vector<double> speed;
  for (const double x : rule.node) {
    const constraints::SurfacePoint p = constraints::evaluate(surface.surface, evaluate(u, x), evaluate(v, x));
    speed.push_back(norm(evaluate(du, x) * p.rU + evaluate(dv, x) * p.rV));
  }
  const SeriesOfOne hand = makeSeriesOfVelocity(projectOnLegendre(speed, rule.node, rule.weight), duration);
  auto prediction = makeLegendrePrediction(hand, std::vector<SeriesOfOne>(massCount, hand), duration);
  describeMotion(motion, *prediction);
  prediction->distance = evaluate(hand.position, 1.0);
  prediction->warnings.emplace_back(kMovesAsOne);
  return prediction;
}

}  // namespace reachlab::predict
