#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/interval.h"
#include "constraints/regularity/analysis.h"

namespace reachlab::constraints {
namespace {

constexpr int kBudget = 6000;                // boxes; what is undecided after them is sampled
constexpr double kLeaf = 1.0 / (1LL << 40);  // of the range: nothing finer is told apart
constexpr double kTouchingLeaf = 1.0 / (1 << 10);

using Box = std::array<Interval, 2>;

std::string placeText(const Constraint& c, const std::array<double, 2>& q) {
  return c.kind == ConstraintKind::Curve ? fmt::format("phi = {:.9g}", q[0]) : fmt::format("u = {:.9g}, v = {:.9g}", q[0], q[1]);
}

// The members of CurvePoint and SurfacePoint, three roots each.
const char* derivativeName(ConstraintKind kind, std::size_t root) {
  static constexpr const char* kCurve[] = {"r", "r_phi", "r_phiphi"};
  static constexpr const char* kSurface[] = {"r", "r_u", "r_v", "r_uu", "r_uv", "r_vv"};
  return kind == ConstraintKind::Curve ? kCurve[root / 3] : kSurface[root / 3];
}

std::string tell(const Constraint& c, std::size_t root, const std::array<double, 2>& q) {
  return std::string(derivativeName(c.kind, root)) + " is not finite at " + placeText(c, q);
}

}  // namespace

std::string findNonFinite(const Constraint& c, const std::array<Domain, 2>& range) {
  if (c.kind == ConstraintKind::Free || c.formula == nullptr) return {};
  const std::size_t dimensions = c.kind == ConstraintKind::Curve ? 1 : 2;
  IntervalEvaluator evaluator(c.formula->graph, c.formula->roots, c.shape());

  std::array<double, 2> extent{};
  for (std::size_t k = 0; k < dimensions; ++k) extent[k] = std::max(range[k].hi - range[k].lo, 1e-300);
  const auto pointwise = [&](const std::array<double, 2>& q) -> std::string {
    std::array<Vec3, 6> values{};
    if (dimensions == 1) {
      const CurvePoint p = evaluate(c.curve, q[0]);
      values = {p.r, p.rPhi, p.rPhiPhi};
    } else {
      const SurfacePoint p = evaluate(c.surface, q[0], q[1]);
      values = {p.r, p.rU, p.rV, p.rUu, p.rUv, p.rVv};
    }
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!isFinite(values[i])) return tell(c, 3 * i, q);
    return {};
  };

  const auto sampled = [&](int n) -> std::string {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= (dimensions == 2 ? n : 0); ++j)
        if (std::string fault = pointwise({range[0].lo + extent[0] * i / n, dimensions == 2 ? range[1].lo + extent[1] * j / n : 0});
            !fault.empty())
          return fault;
    return {};
  };
  // The ends and a few inner points first: whole numbers and halves are where formulas like to break.
  if (std::string fault = sampled(8); !fault.empty()) return fault;

  std::vector<Box> stack{Box{Interval{range[0].lo, range[0].hi}, Interval{range[1].lo, range[1].hi}}};
  int budget = kBudget;
  while (!stack.empty() && budget-- > 0) {
    const Box box = stack.back();
    stack.pop_back();
    const std::vector<Finiteness>& finiteness = evaluator.evaluate(box);
    const auto worst = std::max_element(finiteness.begin(), finiteness.end());
    if (*worst == Finiteness::Finite) continue;
    std::array<double, 2> middle{}, width{};
    for (std::size_t k = 0; k < dimensions; ++k) {
      middle[k] = box[k].lo + (box[k].hi - box[k].lo) / 2;
      width[k] = (box[k].hi - box[k].lo) / extent[k];
    }
    const double widest = std::max(width[0], width[1]);
    if (*worst == Finiteness::Touching && widest <= kTouchingLeaf) continue;
    // The lowest derivative that fails is the one to tell.
    const auto first = std::find_if(finiteness.begin(), finiteness.end(), [&](Finiteness f) { return f == *worst; });
    if (*worst == Finiteness::Nowhere || widest <= kLeaf) return tell(c, static_cast<std::size_t>(first - finiteness.begin()), middle);
    const std::size_t k = width[1] > width[0] ? 1 : 0;
    Box left = box, right = box;
    left[k].hi = middle[k];
    right[k].lo = middle[k];
    stack.push_back(right);
    stack.push_back(left);
  }
  return stack.empty() ? std::string() : sampled(dimensions == 1 ? 2000 : 60);
}

bool degeneratesEverywhere(const Constraint& c, const std::array<Domain, 2>& range) {
  // Irrational places, so that none of them is special to a formula.
  constexpr int kPlaces = 64;
  constexpr double kParallel = 1e-10;  // rounding leaves about 1e-16
  const auto at = [&](std::size_t k, int i, double step) {
    const double fraction = std::fmod(0.5 + i * step, 1.0);
    return range[k].lo + (range[k].hi - range[k].lo) * fraction;
  };
  if (c.kind == ConstraintKind::Free) return false;
  bool valued = false;  // anywhere: where there is nothing, nothing degenerates
  for (int i = 1; i <= kPlaces; ++i) {
    if (c.kind == ConstraintKind::Curve) {
      const CurvePoint p = evaluate(c.curve, at(0, i, 0.6180339887498949));
      if (!std::isfinite(norm(p.r)) || !std::isfinite(norm(p.rPhi))) continue;
      valued = true;
      if (norm(p.rPhi) > 1e-13 * (norm(p.r) + 1e-3)) return false;
    } else {
      const SurfacePoint p = evaluate(c.surface, at(0, i, 0.7548776662466927), at(1, i, 0.5698402909980532));
      if (!std::isfinite(norm(p.r)) || !std::isfinite(norm(p.rU)) || !std::isfinite(norm(p.rV))) continue;
      valued = true;
      const double slow = 1e-13 * (norm(p.r) + 1e-3);
      if (norm(p.rU) > slow && norm(p.rV) > slow && computeAngleSine(p) > kParallel) return false;
    }
  }
  return valued;
}

}  // namespace reachlab::constraints
