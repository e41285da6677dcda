#include <algorithm>
#include <cmath>
#include <numbers>

#include "constraints/formula/interval_series.h"
#include "constraints/regularity/branch_curve.h"
#include "constraints/regularity/curve_search.h"
#include "constraints/regularity/narrow.h"

namespace reachlab::constraints {
namespace {

constexpr int kSamplesOfTurn = 257;   // of a turn, for the usual |r_phi|
constexpr int kDoublings = 20;        // from the first stretch beside the start to the whole window
constexpr double kPointLike = 1e-13;  // of phi or of a metre: a shorter stretch is not halved
constexpr double kAlike = 2;          // reaches of neighbours that are told as one
constexpr std::size_t kMost = 100000;

/// The median of |r_phi| [m]; 0 where it has no value.
double usualSpeed(const Curve& curve, double lo, double hi) {
  std::vector<double> speeds;
  for (int i = 0; i < kSamplesOfTurn && lo < hi; ++i)
    if (const CurvePoint p = evaluate(curve, lo + (hi - lo) * (i + 0.5) / kSamplesOfTurn); isFinite(p)) speeds.push_back(norm(p.rPhi));
  return speeds.empty() ? 0 : narrow::median(speeds);
}

class Searcher {
 public:
  Searcher(const ExpressionGraph& graph, const double* shape, NarrowSearch& search, int boxes)
      : graph_(graph), shape_(shape), search_(search), boxes_(boxes) {}

  /// Looks at the formula from `begin` to `end` and adds its narrow places. Returns how far everything was seen.
  double look(const std::vector<int>& r, double speed, double begin, double end) {
    IntervalSeries& series = seriesOf(r);
    const bool upwards = begin < end;
    const double lo = std::min(begin, end), hi = std::max(begin, end);
    std::vector<Range> open{{lo, hi}};
    const double wide = narrow::kWay / speed;
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (--boxes_ < 0 || search_.places.size() > kMost) return upwards ? a : b;
      const double last = series.bound({Interval{a, b}, Interval{}}, {Interval{1, 1}, Interval{}});
      const double reach = narrow::reachOf(last, speed);
      if (reach >= wide) continue;
      const double middle = a + (b - a) / 2;
      const bool point = !(middle > a && middle < b) || b - a <= kPointLike * std::max({std::abs(a), std::abs(b), 1 / speed});
      if (!std::isfinite(a) || !std::isfinite(b)) return begin;
      if (b - a <= reach || point) {
        if (std::isfinite(last)) add({a, b, reach});
        continue;
      }
      open.push_back(upwards ? Range{middle, b} : Range{a, middle});
      open.push_back(upwards ? Range{a, middle} : Range{middle, b});
    }
    return end;
  }

 private:
  using Range = std::pair<double, double>;
  struct Known {
    std::vector<int> r;
    IntervalSeries series;
  };

  IntervalSeries& seriesOf(const std::vector<int>& r) {
    for (Known& known : known_)
      if (known.r == r) return known.series;
    known_.push_back({r, IntervalSeries(graph_, r, shape_)});
    return known_.back().series;
  }
  void add(const NarrowPlace& place) {
    if (!search_.places.empty()) {
      NarrowPlace& before = search_.places.back();
      const double least = std::min(before.reach, place.reach), most = std::max(most_, place.reach);
      if ((before.hi == place.lo || before.lo == place.hi) && most <= kAlike * least) {
        before = {std::min(before.lo, place.lo), std::max(before.hi, place.hi), least};
        most_ = most;
        return;
      }
    }
    search_.places.push_back(place);
    most_ = place.reach;
  }

  const ExpressionGraph& graph_;
  const double* shape_;
  NarrowSearch& search_;
  int boxes_;
  double most_ = 0;  // the largest reach in the last place
  std::vector<Known> known_;
};

}  // namespace

NarrowSearch findNarrowPlaces(const ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                              const std::vector<std::vector<int>>& formulas, const Domain& window, double about, double period) {
  NarrowSearch search;
  search.lo = search.hi = about;
  std::vector<double> speeds;
  for (const CurvePiece& piece : pieces)
    speeds.push_back(usualSpeed(piece.curve, std::max({piece.lo, about - std::numbers::pi, window.lo}),
                                std::min({piece.hi, about + std::numbers::pi, window.hi})));
  const double usual = [&] {
    std::vector<double> known;
    for (const double speed : speeds)
      if (speed > 0) known.push_back(speed);
    return known.empty() ? 0 : narrow::median(known);
  }();
  if (!(usual > 0)) {  // nothing moves, or nothing has a value
    search.lo = -std::numeric_limits<double>::infinity(), search.hi = -search.lo;
    return search;
  }
  for (double& speed : speeds)
    if (!(speed > 0)) speed = usual;
  Searcher searcher(graph, shape, search, narrow::kBoxes);
  /// From `begin` on through the pieces, and returns how far.
  const auto look = [&](double begin, double end) {
    const bool upwards = begin < end;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::size_t k = upwards ? i : pieces.size() - 1 - i;
      const double a = std::max(std::min(begin, end), pieces[k].lo), b = std::min(std::max(begin, end), pieces[k].hi);
      if (!(a < b)) continue;
      const double to = upwards ? b : a;
      if (const double seen = searcher.look(formulas[k], speeds[k], upwards ? a : b, to); seen != to) return seen;
    }
    return end;
  };
  const double inf = std::numeric_limits<double>::infinity();
  std::array<bool, 2> open{true, true};
  const std::array<double, 2> windowEnd{window.lo, window.hi}, lastEnd{pieces.front().lo, pieces.back().hi};
  const std::array<double*, 2> reached{&search.lo, &search.hi};
  const auto lookOn = [&](std::size_t side, double to) {
    if (!open[side] || *reached[side] == to) return;
    *reached[side] = look(*reached[side], to);
    open[side] = *reached[side] == to;
  };
  for (int k = kDoublings; k >= 0; --k)
    for (std::size_t side = 0; side < 2; ++side) lookOn(side, about + std::ldexp(windowEnd[side] - about, -k));
  if (period > 0 && search.places.empty() && search.hi - search.lo >= period) return {{}, -inf, inf};
  for (std::size_t side = 0; side < 2; ++side) lookOn(side, lastEnd[side]);
  if (search.lo <= lastEnd[0]) search.lo = -inf;
  if (search.hi >= lastEnd[1]) search.hi = inf;
  std::erase_if(search.places, [&](const NarrowPlace& place) { return place.hi <= search.lo || place.lo >= search.hi; });
  std::sort(search.places.begin(), search.places.end(), [](const NarrowPlace& a, const NarrowPlace& b) { return a.lo < b.lo; });
  return search;
}

}  // namespace reachlab::constraints
