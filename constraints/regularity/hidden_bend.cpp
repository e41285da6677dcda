#include "constraints/regularity/hidden_bend.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/formula/formula.h"
#include "constraints/formula/interval.h"

namespace reachlab::constraints {
namespace {

constexpr int kPieces = 512;
constexpr double kMuch = 2;         // times the largest at the samples: what is resolved stays below
constexpr double kAside = 0.25;     // of a piece's box, that the way may leave it by
constexpr double kShortest = 1e-9;  // of the way
constexpr double kWork = 2e7;       // operations on intervals, a third of a second

constexpr int kSecond = 3, kThird = 4;  // derivatives: uu, uv, vv; uuu, uuv, uvv, vvv

class Bends {
 public:
  Bends(ExpressionGraph& graph, std::span<const int> r, const double* shape) : evaluator_(graph, rootsOf(graph, r), shape) {}

  /// Bound of |3 (r_uu u' u'' + …)| + |r_uuu u'^3 + …|, for parameters in the box and rates up to these.
  double bound(const std::array<Interval, 2>& box, const std::array<double, 2>& rate, const std::array<double, 2>& acceleration) {
    for (const Finiteness f : evaluator_.evaluate(box))
      if (f != Finiteness::Finite) return std::numeric_limits<double>::infinity();
    const double u = rate[0], v = rate[1], uu = acceleration[0], vv = acceleration[1];
    const std::array<double, kSecond + kThird> factor{3 * u * uu,    3 * (u * vv + v * uu), 3 * v * vv, u * u * u,
                                                      3 * u * u * v, 3 * u * v * v,         v * v * v};
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t d = 0; d < factor.size(); ++d) {
        const Interval range = evaluator_.rangeOf(3 * d + k);
        sum += factor[d] * std::max(std::abs(range.lo), std::abs(range.hi));
      }
      squares += sum * sum;
    }
    return std::sqrt(squares);
  }

 private:
  static std::vector<int> rootsOf(ExpressionGraph& graph, std::span<const int> r) {
    std::vector<int> all = withDerivatives(graph, r, ConstraintKind::Surface);
    all.erase(all.begin(), all.begin() + 9);  // r, r_u, r_v
    const std::vector<int> uu(all.begin(), all.begin() + 3), vv(all.begin() + 6, all.end());
    for (const std::vector<int>& second : {uu, vv})
      for (const int variable : {0, 1}) {
        const std::vector<int> third = graph.differentiate(second, variable);
        all.insert(all.end(), third.begin(), third.end());
      }
    return all;
  }
  IntervalEvaluator evaluator_;
};

std::array<double, 2> magnitudes(const std::array<double, 2>& x) { return {std::abs(x[0]), std::abs(x[1])}; }

struct Piece {
  double lo = 0, hi = 0;
  WayPoint begin, end;
};

}  // namespace

std::optional<HiddenBend> findHiddenBend(const Constraint& surface, const std::function<WayPoint(double)>& way, double least) {
  if (surface.surface.function != evaluateSurfaceProgram) return {};
  ExpressionGraph graph = surface.formula->graph;
  try {
    Bends bends(graph, surface.formula->place(), surface.shape());
    const auto at = [&](const WayPoint& p) {
      return bends.bound({Interval{p.q[0], p.q[0]}, Interval{p.q[1], p.q[1]}}, magnitudes(p.rate), magnitudes(p.acceleration));
    };
    std::vector<WayPoint> sample;
    double most = least;
    for (int i = 0; i <= kPieces; ++i) {
      sample.push_back(way(i / double{kPieces}));
      if (const double here = at(sample.back()); std::isfinite(here)) most = std::max(most, kMuch * here);
    }
    std::vector<Piece> open;
    for (int i = kPieces; i-- > 0;)
      open.push_back({i / double{kPieces}, (i + 1) / double{kPieces}, sample[i], sample[static_cast<std::size_t>(i) + 1]});
    double work = kWork;
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      const double middle = piece.lo + (piece.hi - piece.lo) / 2;
      const WayPoint between = way(middle);
      std::array<Interval, 2> box;
      std::array<double, 2> rate{}, acceleration{};
      for (std::size_t k = 0; k < 2; ++k) {
        const auto [lo, hi] = std::minmax({piece.begin.q[k], between.q[k], piece.end.q[k]});
        box[k] = {lo - kAside * (hi - lo), hi + kAside * (hi - lo)};
        for (const WayPoint* p : {&piece.begin, &between, &piece.end}) {
          rate[k] = std::max(rate[k], std::abs(p->rate[k]));
          acceleration[k] = std::max(acceleration[k], std::abs(p->acceleration[k]));
        }
      }
      work -= 2 * graph.size();
      if (bends.bound(box, rate, acceleration) <= most) continue;
      if (const double here = at(between); std::isfinite(here) && here > most) return HiddenBend{true, between.q};
      if (piece.hi - piece.lo < kShortest || work < 0) return HiddenBend{false, between.q};
      open.push_back({middle, piece.hi, between, piece.end});
      open.push_back({piece.lo, middle, piece.begin, between});
    }
  } catch (const FaultError&) {  // third derivatives too large to be formed: nothing is known
    return HiddenBend{false, way(0.5).q};
  }
  return {};
}

}  // namespace reachlab::constraints
