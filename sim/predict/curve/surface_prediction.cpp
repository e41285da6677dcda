#include "sim/predict/curve/path_predictions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "base/error.h"
#include "constraints/geometry/surface_expansion.h"
#include "constraints/regularity/hidden_bend.h"
#include "constraints/regularity/surface_branches.h"
#include "sim/predict/numerics/hyper_dual.h"
#include "sim/predict/transcription/transcription.h"

namespace reachlab::predict {
namespace {

double component(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

// A hand whose parameters move with these first, second and third derivatives.
PathPoint computePathPoint(const constraints::SurfaceExpansion& d, const std::array<double, 3>& du, const std::array<double, 3>& dv) {
  const double u = du[0], v = dv[0];
  return {d[0][0], u * d[1][0] + v * d[0][1], u * u * d[2][0] + 2 * u * v * d[1][1] + v * v * d[0][2] + du[1] * d[1][0] + dv[1] * d[0][1],
          u * u * u * d[3][0] + 3 * u * u * v * d[2][1] + 3 * u * v * v * d[1][2] + v * v * v * d[0][3] + 3 * u * du[1] * d[2][0] +
              3 * (u * dv[1] + du[1] * v) * d[1][1] + 3 * v * dv[1] * d[0][2] + du[2] * d[1][0] + dv[2] * d[0][1]};
}

/// The lines across which the surface's formula is not smooth, held against the finished way: a movement of finite jerk crosses none, but
/// where both sides agree to the second derivative.
void refuseAtLines(const constraints::Constraint& surface, const std::function<std::array<double, 2>(double share)>& way) {
  constexpr int kLooks = 4000;
  constexpr double kAgrees = 1e-9;
  const auto branches = constraints::computeBranches(surface);
  if (branches->smooth()) return;
  std::array<double, 2> q = way(0);
  auto before = branches->at(q[0], q[1]);
  for (int i = 1; i <= kLooks; ++i) {
    q = way(i / double{kLooks});
    const auto after = branches->at(q[0], q[1]);
    int branch = 0;
    for (std::size_t k = 0; k < branches->lines.size(); ++k)
      if (const int bit = branches->lines[k].bit; bit >= 0 && after[k].value > 0) branch |= 1 << bit;
    for (std::size_t k = 0; k < branches->lines.size(); ++k) {
      const constraints::SurfaceBranches::Line& line = branches->lines[k];
      if (before[k].value * after[k].value > 0 || (i == kLooks && after[k].value == 0) || (i == 1 && before[k].value == 0)) continue;
      if (line.passable) {
        // To the line itself, and both sides' formulas there.
        const double slope = after[k].u * after[k].u + after[k].v * after[k].v;
        const double u = q[0] - after[k].value * after[k].u / slope, v = q[1] - after[k].value * after[k].v / slope;
        const constraints::SurfacePoint a = evaluate(branches->branches[branch], u, v),
                                        b = evaluate(branches->branches[branch ^ (1 << line.bit)], u, v);
        const double size = norm(a.r) + norm(a.rU) + norm(a.rV) + norm(a.rUu) + norm(a.rUv) + norm(a.rVv);
        if (norm(a.r - b.r) + norm(a.rU - b.rU) + norm(a.rV - b.rV) + norm(a.rUu - b.rUu) + norm(a.rUv - b.rUv) + norm(a.rVv - b.rVv) <=
            kAgrees * size)
          continue;
      }
      throw RefusedError(
          fmt::format("the way crosses a place where the surface has a kink, a jump or an end ({}: {}) at u = {:.6g}, v = {:.6g}: no "
                      "movement of finite jerk passes it but at rest; allowed: a start and a target with none between them",
                      nameOf(line.kind), line.because, q[0], q[1]));
    }
    before = after;
  }
}

/// What no node of the movement sees: a bump between two of them. Words where it can be neither found nor ruled out.
std::optional<std::string> refuseHiddenBend(const constraints::Constraint& surface, const TranscribedMotion& motion) {
  constexpr double kLeast = 1e-3;  // of the movement's mean jerk: what is below changes its cost by less than the nodes' distance squared
  const double least = kLeast * std::sqrt(motion.cost / motion.duration);
  const auto way = [&](double share) {
    const std::array u = motion.at(0, share * motion.duration), v = motion.at(1, share * motion.duration);
    return constraints::WayPoint{{u[0], v[0]}, {u[1], v[1]}, {u[2], v[2]}};
  };
  const std::optional<constraints::HiddenBend> bend = constraints::findHiddenBend(surface, way, least);
  if (!bend) return std::nullopt;
  const std::string place = fmt::format("u = {:.6g}, v = {:.6g}", bend->at[0], bend->at[1]);
  if (bend->found)
    throw RefusedError(
        fmt::format("the way has a bump too narrow to be resolved at {}; allowed: a start and a target with none between them", place));
  return fmt::format("near {} nothing shows that the surface has no bump too narrow to be seen", place);
}

}  // namespace

std::unique_ptr<Prediction> makeSurfaceJerkPrediction(const constraints::Constraint& surface, const std::vector<double>& start,
                                                      const std::vector<double>& target, double duration, int massCount, int unknowns) {
  constexpr int kLocals = 8;
  TranscribedProblem problem;
  problem.duration = duration;
  problem.residuals = 3;
  problem.from = start;
  problem.to = target;
  problem.takeDerivativesAsLocals();
  const constraints::SurfaceFormula formula(surface);
  problem.residual = [&](const double* a, double* r, double* ra, double* raa) {
    using S = HyperDual<kLocals>;
    const constraints::SurfaceExpansion d = formula.expand(a[0], a[4], ra == nullptr ? 3 : 5);
    if (ra == nullptr) {
      const Vec3 plain = computePathPoint(d, {a[1], a[2], a[3]}, {a[5], a[6], a[7]}).jerk;
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
        c.gradient[0] = component(d[i + 1][j], k);
        c.gradient[4] = component(d[i][j + 1], k);
        c.hessian[0] = component(d[i + 2][j], k);
        c.hessian[4] = c.hessian[4 * kLocals] = component(d[i + 1][j + 1], k);
        c.hessian[4 * kLocals + 4] = component(d[i][j + 2], k);
        return c;
      };
      jerk[k] = partial(3, 0) * uuu + partial(2, 1) * uuv + partial(1, 2) * uvv + partial(0, 3) * vvv + partial(2, 0) * uu +
                partial(1, 1) * uv + partial(0, 2) * vv + partial(1, 0) * u3 + partial(0, 1) * v3;
    }
    store(jerk, r, ra, raa);
  };
  const Vec3 chord = evaluate(surface.surface, target[0], target[1]).r - evaluate(surface.surface, start[0], start[1]).r;
  const constraints::SurfacePoint middle = evaluate(surface.surface, (start[0] + target[0]) / 2, (start[1] + target[1]) / 2);
  for (size_t m = 0; m < 2; ++m) {  // a tenth of the way to the side at least, in whatever unit the parameter has
    const double speed = norm(m == 0 ? middle.rU : middle.rV), aside = std::isnormal(speed) ? 0.1 * norm(chord) / speed : 0;
    problem.detour.push_back(std::max({std::abs(target[m] - start[m]), aside, 1e-9 * (1 + std::abs(start[m]))}));
  }
  const TranscribedMotion motion = solveFromStarts(problem, unknowns, [&](const TranscribedMotion& found, double t) {
    const auto [u, u1, u2, u3] = found.at(0, t);
    const auto [v, v1, v2, v3] = found.at(1, t);
    return computePathPoint(formula.expand(u, v, 3), {u1, u2, u3}, {v1, v2, v3});
  });
  const LegendreSeries u = motion.derivative(0, 0), v = motion.derivative(1, 0), du = motion.derivative(0, 1), dv = motion.derivative(1, 1);
  refuseAtLines(surface, [&](double share) { return std::array{valueAt(u, 2 * share - 1), valueAt(v, 2 * share - 1)}; });
  const MotionSeries hand = makeSeriesOfSpeed(
      [&](double t) {
        const double x = 2 * t / duration - 1;
        const constraints::SurfacePoint p = evaluate(surface.surface, valueAt(u, x), valueAt(v, x));
        return norm(valueAt(du, x) * p.rU + valueAt(dv, x) * p.rV);
      },
      motion.basis.columns(), duration);
  const std::optional<std::string> unseen = refuseHiddenBend(surface, motion);
  auto prediction = makeLegendrePrediction(hand, std::vector<MotionSeries>(massCount, hand), duration);
  describeMotion(motion, *prediction);
  if (unseen) prediction->warnings.push_back(*unseen);
  prediction->distance = valueAt(hand.position, 1.0);
  prediction->warnings.emplace_back(kMovesAsOne);
  return prediction;
}

}  // namespace reachlab::predict
