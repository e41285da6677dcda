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
constexpr double kAlike = 2;          // stretches whose reaches differ by less than this factor are one place
constexpr double kBlind = 0.02;       // of a piece, beside its ends of that kind
constexpr double kRipple = 3;         // times the reach of a stretch, that its places may allow
constexpr std::size_t kMost = 100000;

/// The median of |r_phi| [m]; 0 where it has no value.
double usualSpeed(const Curve& curve, double lo, double hi) {
  std::vector<double> speeds;
  for (int i = 0; i < kSamplesOfTurn && lo < hi; ++i)
    if (const CurvePoint p = evaluate(curve, lo + (hi - lo) * (i + 0.5) / kSamplesOfTurn); isFinite(p)) speeds.push_back(norm(p.rPhi));
  return speeds.empty() ? 0 : narrow::median(speeds);
}

/// The places of one period, throughout the window.
NarrowSearch repeated(const NarrowSearch& search, double period, const Domain& window) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<NarrowPlace> one;
  for (NarrowPlace place : search.places) {
    place.lo = std::max(place.lo, search.lo);
    place.hi = std::min(place.hi, search.lo + period);
    if (place.lo < place.hi) one.push_back(place);
  }
  if (one.empty()) return {{}, -inf, inf};
  std::sort(one.begin(), one.end(), [](const NarrowPlace& a, const NarrowPlace& b) { return a.lo < b.lo; });
  const double most = std::floor(static_cast<double>(kMost / one.size()) / 2);  // periods either way
  const double first = std::max(std::floor((window.lo - search.lo) / period), -most),
               last = std::min(std::ceil((window.hi - search.lo) / period), most);
  NarrowSearch all{{}, search.lo + first * period, search.lo + last * period};
  for (double k = first; k < last; ++k)
    for (const NarrowPlace& place : one) all.places.push_back({place.lo + k * period, place.hi + k * period, place.reach});
  return all;
}

class Searcher {
 public:
  Searcher(const ExpressionGraph& graph, const double* shape, const std::vector<double>& blind, NarrowSearch& search)
      : graph_(graph), shape_(shape), blind_(blind), search_(search) {}

  /// Looks at the formula from `begin` to `end`, on a piece of that width, and adds its narrow places. Returns how far everything was seen.
  double look(const std::vector<int>& r, double speed, double width, double begin, double end) {
    IntervalSeries& series = seriesOf(r);
    const bool upwards = begin < end;
    const double lo = std::min(begin, end), hi = std::max(begin, end);
    std::vector<Range> open{{lo, hi}};
    const double wide = narrow::kWay / speed, near = std::min(wide, kBlind * width);
    while (!open.empty()) {
      const auto [a, b] = open.back();
      open.pop_back();
      if (isBlind(a, b, near)) continue;
      if (--boxes_ < 0 || search_.places.size() > kMost) return upwards ? a : b;
      const double last = series.bound({Interval{a, b}, Interval{}}, {Interval{1, 1}, Interval{}});
      const double reach = narrow::reachOf(last, std::max(speed, series.leastSlope()));
      if (reach >= wide) continue;
      const double middle = a + (b - a) / 2;
      if (!std::isfinite(last) && b - a <= wide && !std::isfinite(boundAt(series, middle))) continue;  // beyond the numbers of a computer
      const bool point = !(middle > a && middle < b) || b - a <= kPointLike * std::max({std::abs(a), std::abs(b), 1 / speed});
      if (!std::isfinite(a) || !std::isfinite(b)) return begin;
      if (b - a <= reach || point || isEverywhere(series, speed, a, b, reach)) {
        if (std::isfinite(last) && reach < narrow::kWay / speedAbout(series, speed, a, b, reach)) add({a, b, reach});
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

  static double boundAt(IntervalSeries& series, double phi) {
    return series.bound({Interval{phi, phi}, Interval{}}, {Interval{1, 1}, Interval{}});
  }
  /// |r_phi| [m] where a mass comes from to a stretch, at least the usual one.
  static double speedAbout(IntervalSeries& series, double usual, double a, double b, double reach) {
    constexpr double kAway = 16;
    const double away = kAway * std::max(b - a, reach);
    double least = std::numeric_limits<double>::infinity();
    for (const double phi : {a - away, b + away}) {
      static_cast<void>(boundAt(series, phi));
      least = std::min(least, series.leastSlope());
    }
    return std::max(usual, least);
  }
  bool isBlind(double a, double b, double near) const {
    const auto above = std::lower_bound(blind_.begin(), blind_.end(), a);
    return (above != blind_.end() && *above - a <= near && b - *above <= near) || (above != blind_.begin() && b - *(above - 1) <= near);
  }
  /// The formula is as narrow at each of some places as the bound for the whole stretch: a ripple, which is not halved to its waves.
  static bool isEverywhere(IntervalSeries& series, double speed, double a, double b, double reach) {
    for (const double share : {0.3, 0.55, 0.78, 0.12, 0.91}) {
      const double phi = a + (b - a) * share;
      const double last = boundAt(series, phi);
      if (!(narrow::reachOf(last, std::max(speed, series.leastSlope())) <= kRipple * reach)) return false;
    }
    return true;
  }
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
  const std::vector<double>& blind_;
  NarrowSearch& search_;
  int boxes_ = narrow::kBoxes;
  double most_ = 0;  // the largest reach in the last place
  std::vector<Known> known_;
};

}  // namespace

NarrowSearch findNarrowPlaces(const ExpressionGraph& graph, const double* shape, const std::vector<CurvePiece>& pieces,
                              const std::vector<std::vector<int>>& formulas, const std::vector<double>& blind, const Domain& window,
                              double about, double period) {
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
  Searcher searcher(graph, shape, blind, search);
  /// From `begin` on through the pieces, and returns how far.
  const auto look = [&](double begin, double end) {
    const bool upwards = begin < end;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const std::size_t k = upwards ? i : pieces.size() - 1 - i;
      const double a = std::max(std::min(begin, end), pieces[k].lo), b = std::min(std::max(begin, end), pieces[k].hi);
      if (!(a < b)) continue;
      const double to = upwards ? b : a;
      const double seen = searcher.look(formulas[k], speeds[k], pieces[k].hi - pieces[k].lo, upwards ? a : b, to);
      if (seen != to) return seen;
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
  const auto sawPeriod = [&] { return period > 0 && search.hi - search.lo >= period; };
  for (int k = kDoublings; k >= 0 && !sawPeriod(); --k)
    for (std::size_t side = 0; side < 2; ++side) lookOn(side, about + std::ldexp(windowEnd[side] - about, -k));
  if (sawPeriod()) return repeated(search, period, window);
  for (std::size_t side = 0; side < 2; ++side) lookOn(side, lastEnd[side]);
  if (search.lo <= lastEnd[0]) search.lo = -inf;
  if (search.hi >= lastEnd[1]) search.hi = inf;
  std::erase_if(search.places, [&](const NarrowPlace& place) { return place.hi <= search.lo || place.lo >= search.hi; });
  std::sort(search.places.begin(), search.places.end(), [](const NarrowPlace& a, const NarrowPlace& b) { return a.lo < b.lo; });
  return search;
}

}  // namespace reachlab::constraints
