#include "constraints/regularity/period.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/guards.h"

namespace reachlab::constraints {
namespace {

/// Slopes a of every sine, cosine and tangent of a phi + b; false where phi stands anywhere else.
class Slopes {
 public:
  Slopes(const ExpressionGraph& graph, const double* shape) : graph_(graph), shape_(shape), moving_(findMoving(graph)) {}

  bool collect(int root, std::vector<double>& slopes) const {
    std::vector<bool> reached(root + 1, false);
    reached[root] = true;
    for (int id = root; id >= 0; --id) {
      if (!reached[id] || !moving_[id]) continue;
      const ExpressionNode& n = graph_.node(id);
      if (n.op == Op::Variable) return false;
      if (n.op == Op::Sin || n.op == Op::Cos || n.op == Op::Tan) {
        if (double slope = 0; isAffine(n.a, slope)) {
          slopes.push_back(std::abs(slope));
          continue;
        }
      }
      reached[n.a] = true;
      if (operandCount(n.op) == 2) reached[n.b] = true;
    }
    return true;
  }

 private:
  double numberOf(int id) const {
    const double nowhere = 0;
    return evaluateNode(graph_, id, shape_, &nowhere);
  }
  bool isAffine(int id, double& slope) const {
    if (!moving_[id]) {
      slope = 0;
      return true;
    }
    const ExpressionNode& n = graph_.node(id);
    double a = 0, b = 0;
    switch (n.op) {
      case Op::Variable: slope = 1; return true;
      case Op::Neg: return isAffine(n.a, a) && (slope = -a, true);
      case Op::Add: return isAffine(n.a, a) && isAffine(n.b, b) && (slope = a + b, true);
      case Op::Sub: return isAffine(n.a, a) && isAffine(n.b, b) && (slope = a - b, true);
      case Op::Mul:
        if (!moving_[n.a]) return isAffine(n.b, b) && (slope = numberOf(n.a) * b, true);
        if (!moving_[n.b]) return isAffine(n.a, a) && (slope = numberOf(n.b) * a, true);
        return false;
      case Op::Div: return !moving_[n.b] && isAffine(n.a, a) && (slope = a / numberOf(n.b), true);
      default: return false;
    }
  }

  const ExpressionGraph& graph_;
  const double* shape_;
  std::vector<bool> moving_;
};

}  // namespace

Period findPeriod(const Constraint& curve) {
  constexpr long double kTurn = 6.283185307179586476925286766559L;
  constexpr double kSame = 1e-12;
  constexpr int kMost = 64;
  if (curve.kind != ConstraintKind::Curve || curve.formula == nullptr) return {};
  const Slopes all(curve.formula->graph, curve.shape());
  std::vector<double> slopes;
  for (const int root : curve.formula->place())
    if (!all.collect(root, slopes)) return {};
  double least = std::numeric_limits<double>::infinity();
  for (const double a : slopes)
    if (a > 0) least = std::min(least, a);
  if (!std::isfinite(least)) return {};
  for (int turns = 1; turns <= kMost; ++turns) {
    bool whole = true;
    for (const double a : slopes) {
      const double count = a / least * turns;
      whole = whole && std::abs(count - std::nearbyint(count)) <= kSame * count;
    }
    if (!whole) continue;
    const long double period = kTurn * turns / static_cast<long double>(least);
    const double turn = static_cast<double>(period);
    return {turn, static_cast<double>(period - static_cast<long double>(turn))};
  }
  return {};
}

}  // namespace reachlab::constraints
