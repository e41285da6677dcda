#include "constraints/formula/roots.h"

#include <algorithm>
#include <cmath>

#include "constraints/formula/interval.h"

namespace reachlab::constraints {
namespace {

constexpr double kLeaf = 1e-13;  // of |phi| + a thousandth of the stretch

bool holdsZero(Interval a) { return !(a.lo > 0 || a.hi < 0); }

}  // namespace

RootSearch findRoots(ExpressionGraph& graph, int expression, const double* shape, double lo, double hi, int& boxes, double apart,
                     int variable, double other) {
  RootSearch found;
  found.examinedTo = hi;
  if (graph.isConstant(expression)) return found;
  const int slope = graph.differentiate(std::span(&expression, 1), variable)[0];
  IntervalEvaluator bounds(graph, std::array{expression, slope}, shape), value(graph, std::span(&expression, 1), shape);
  const auto boxOf = [&](double a, double b) {
    std::array<Interval, 2> box{Interval{other, other}, Interval{other, other}};
    box[variable] = {a, b};
    return box;
  };
  const auto at = [&](double phi) {
    value.evaluate(boxOf(phi, phi));
    return value.rangeOf(0).lo;
  };
  struct Cluster {
    double lo, hi;
  };
  std::vector<Cluster> clusters;
  const double leaf = 1e-3 * kLeaf * (hi - lo);
  const auto add = [&](double a, double b) {
    if (!clusters.empty() && a - clusters.back().hi <= apart * std::max(1.0, std::abs(a)))
      clusters.back().hi = std::max(clusters.back().hi, b);
    else clusters.push_back({a, b});
  };
  std::vector<Cluster> stack{{lo, hi}};
  while (!stack.empty()) {
    const Cluster box = stack.back();
    stack.pop_back();
    if (--boxes < 0) {
      found.examinedTo = box.lo;
      break;
    }
    bounds.evaluate(boxOf(box.lo, box.hi));
    if (!holdsZero(bounds.rangeOf(0))) continue;
    const double middle = box.lo + (box.hi - box.lo) / 2;
    if (!holdsZero(bounds.rangeOf(1)) && std::isfinite(bounds.rangeOf(1).lo) && std::isfinite(bounds.rangeOf(1).hi)) {
      const double first = at(box.lo), last = at(box.hi);
      if (first == 0) add(box.lo, box.lo);
      else if (last == 0) add(box.hi, box.hi);
      else if ((first < 0) != (last < 0)) {
        double a = box.lo, b = box.hi;
        for (double m = a + (b - a) / 2; m > a && m < b; m = a + (b - a) / 2) {
          const double v = at(m);
          if (v == 0) a = b = m;
          else ((v < 0) == (first < 0) ? a : b) = m;
        }
        const double root = std::abs(at(a)) <= std::abs(at(b)) ? a : b;
        add(root, root);
      }
      continue;
    }
    if (!(middle > box.lo && middle < box.hi) || box.hi - box.lo <= kLeaf * std::max(std::abs(box.lo), std::abs(box.hi)) + leaf) {
      add(box.lo, box.hi);
      continue;
    }
    stack.push_back({middle, box.hi});
    stack.push_back({box.lo, middle});
  }
  for (const Cluster& c : clusters) {
    // Of a place that could not be resolved, where the expression is smallest.
    double best = c.lo;
    const double grid[] = {c.lo + (c.hi - c.lo) / 2, c.hi, std::round(c.lo), 0.0};
    for (const double phi : grid)
      if (phi >= c.lo && phi <= c.hi && std::abs(at(phi)) < std::abs(at(best))) best = phi;
    found.roots.push_back(best);
  }
  return found;
}

}  // namespace reachlab::constraints
