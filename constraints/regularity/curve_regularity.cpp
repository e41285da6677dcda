#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "constraints/formula/formula.h"
#include "constraints/formula/guards.h"
#include "constraints/formula/interval.h"
#include "constraints/formula/roots.h"
#include "constraints/regularity/narrow.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {
namespace {

constexpr double kTurns = 64 * 2 * std::numbers::pi;
constexpr double kReach = 10;         // [m] that are examined at least either way
constexpr double kContinuous = 1e-9;  // of a millimetre and of the curve's size: what counts as no jump
constexpr double kRounding = 1e-12;   // of |r|, for a curve may lie far away, and of phi
constexpr double kLost = 1e-10;       // [m] a mass moves this far by a rounding of phi: nearer a pole phi tells places apart no more,
constexpr double kFarLost = 1e-15;    // or this part of |r|, which is rounded itself
constexpr std::size_t kMaxPlaces = 2000;
constexpr int kMaxBoxes = 100000;   // stretches looked at: tenths of a second
constexpr double kTouching = 1e-7;  // a root or an arc that touches the end of its domain has lost half its digits there

/// A branch's program, continued by its tangent beyond `lo` and `hi`, where the formula itself has no value.
struct PieceProgram {
  std::shared_ptr<const Program> program;
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
};

void evaluatePiece(const void* data, const double* shape, double phi, CurvePoint& out) noexcept {
  const PieceProgram& piece = *static_cast<const PieceProgram*>(data);
  const double at = std::fmin(std::fmax(phi, piece.lo), piece.hi);
  evaluateCurveProgram(piece.program.get(), shape, at, out);
  if (at == phi) return;
  out.r += (phi - at) * out.rPhi;
  out.rPhiPhi = {};
}
void evaluatePieceBatch(const void* data, const double* shape, const double* phi, CurveBatch& out) noexcept {
  evaluateSingly(evaluatePiece, data, shape, phi, out);
}

/// [m] by how much two limits at phi = b may differ that are one; `move`: how far a unit of phi leads from there.
double slack(const CurvePoint& p, double b, double move) {
  return kContinuous * (1e-3 + std::min(move, norm(p.r))) + kRounding * (norm(p.r) + norm(p.rPhi) * std::max(1.0, std::abs(b)));
}

bool isFinite(const CurvePoint& p) { return reachlab::isFinite(p.r) && reachlab::isFinite(p.rPhi) && reachlab::isFinite(p.rPhiPhi); }

class Examiner {
 public:
  Examiner(const Constraint& c, double about)
      : c_(c), formula_(*std::static_pointer_cast<const CompiledFormula>(c.owner)), graph_(formula_.graph), shape_(c.curve.shape.data()),
        about_(about) {
    const auto& r = formula_.derivatives[0];
    r_.assign(r.begin(), r.end());
    guards_ = findGuards(graph_, r_, shape_);
  }

  CurveRegularity examine() {
    const Domain& domain = c_.domain[0];
    const double inf = std::numeric_limits<double>::infinity();
    return examine(domain.periodic ? -inf : domain.lo, domain.periodic ? inf : domain.hi, true);
  }
  CurveRegularity examine(double lo, double hi, bool stillPlaces) {
    lo_ = lo;
    hi_ = hi;
    stillPlaces_ = stillPlaces;
    if (provedWithin(lo, hi)) {
      const bool bounded = std::isfinite(lo) && std::isfinite(hi);
      const auto [from, to] = window(lo, hi, bounded ? 1 : 1.0 / 16);  // still places are met in the motion anyway
      result_.lo = lo;
      result_.hi = hi;
      result_.whole = true;
      result_.pieces = {{lo, hi, c_.curve}};
      result_.owner = c_.owner;
      addCusps(c_.curve, r_, from, to);
      splitNarrow({r_});
      if (!std::isfinite(lo) && !c_.domain[0].periodic) addFarEnd(-1);
      if (!std::isfinite(hi) && !c_.domain[0].periodic) addFarEnd(1);
      result_.smooth = result_.places.empty();
      return std::move(result_);
    }
    for (double share = 1; share > 1e-7; share /= 16) {
      if (!split(lo, hi, share)) continue;
      classify();
      return std::move(result_);
    }
    result_.lo = result_.hi = about_;
    return std::move(result_);
  }

 private:
  struct Stretch {
    double lo, hi;
    std::vector<int> signs;  // of each guard's argument - level
    std::vector<std::size_t> guardsAtLo;
  };

  bool provedWithin(double lo, double hi) {
    for (const Guard& g : guards_) {
      const std::vector<int> argument{g.argument};
      IntervalEvaluator bounds(graph_, argument, shape_);
      bounds.evaluate({Interval{lo, hi}, Interval{}});
      const Interval range = bounds.rangeOf(0);
      if (g.op == Op::Atan2) {  // its cut lies where x < 0
        const std::vector<int> x{graph_.node(g.node).b};
        IntervalEvaluator right(graph_, x, shape_);
        right.evaluate({Interval{lo, hi}, Interval{}});
        if (right.rangeOf(0).lo > 0) continue;
      }
      if (!(range.lo > g.level || range.hi < g.level)) return false;
    }
    return true;
  }

  /// A curve may come to its end only as phi grows without bound (tanh(phi)): from some phi on each doubling of it adds less.
  void addFarEnd(double direction) {
    constexpr int kFirst = 8, kLast = 40;
    double before = std::numeric_limits<double>::infinity();
    Vec3 last = evaluate(c_.curve, about_ + direction * std::ldexp(1.0, kFirst)).r;
    for (int k = kFirst; k < kLast; ++k) {
      double way = 0;  // by chords at uneven places, so that none meets a period
      for (const double share : {1.234, 1.4142, 1.618, 1.8, 2.0}) {
        const Vec3 r = evaluate(c_.curve, about_ + direction * std::ldexp(share, k)).r;
        way += norm(r - last);
        last = r;
      }
      if (!(way <= 0.9 * before)) return;
      before = way;
    }
    Place place;
    place.kind = PlaceKind::End;
    place.at = direction * std::numeric_limits<double>::infinity();
    place.r = last;
    place.because = "r comes to rest";
    result_.places.push_back(place);
  }

  std::pair<double, double> window(double lo, double hi, double share) const {
    double half = kTurns;
    if (const double speed = norm(evaluate(c_.curve, about_).rPhi); speed > 0 && std::isfinite(speed))
      half = std::max(half, kReach / speed);
    half = std::min(half, 1e12) * share;
    if (share == 1 && std::isfinite(lo) && std::isfinite(hi)) return {lo, hi};
    return {std::max(lo, about_ - half), std::min(hi, about_ + half)};
  }

  /// Stretches between the places where a guard's argument meets its level; false if that took too much.
  bool split(double domainLo, double domainHi, double share) {
    auto [lo, hi] = window(domainLo, domainHi, share);
    stretches_ = {{lo, hi, {}, {}}};
    atHi_.clear();
    int boxes = kMaxBoxes;
    for (std::size_t k = 0; k < guards_.size(); ++k) {
      std::vector<Stretch> next;
      for (const Stretch& s : stretches_) {
        const int argument = frozen({guards_[k].argument}, s.signs)[0];
        const int g = guards_[k].level == 0 ? argument : graph_.sub(argument, graph_.constant(guards_[k].level));
        const RootSearch search = findRoots(graph_, g, shape_, s.lo, s.hi, boxes, guards_[k].branches() ? 1e-12 : kTouching);
        if (search.examinedTo < s.hi && s.lo <= about_ + 1e-9) return false;
        double from = s.lo;
        std::vector<std::size_t> guardsAtFrom = s.guardsAtLo;
        const double near = 1e-12 * std::max({1.0, std::abs(s.lo), std::abs(s.hi)});
        const auto close = [&](double to) {
          Stretch piece{from, to, s.signs, guardsAtFrom};
          piece.signs.push_back(signOn(g, from, to));
          next.push_back(piece);
        };
        for (const double root : search.roots) {
          if (root - from <= near) {  // at its beginning, where another guard decides as well
            guardsAtFrom.push_back(k);
            continue;
          }
          if (s.hi - root <= near) {
            atHi_.push_back({s.hi, k});
            continue;
          }
          close(root);
          from = root;
          guardsAtFrom = {k};
        }
        close(s.hi);
        if (search.examinedTo < s.hi) hi = std::min(hi, search.examinedTo);
      }
      stretches_ = std::move(next);
    }
    while (!stretches_.empty() && stretches_.back().lo >= hi) stretches_.pop_back();
    if (stretches_.empty() || stretches_.size() > kMaxPlaces || hi < about_) return false;
    stretches_.back().hi = std::min(stretches_.back().hi, hi);
    result_.lo = lo;
    result_.hi = hi;
    return true;
  }

  int signOn(int g, double lo, double hi) {
    const std::vector<int> one{g};
    int sign = 0;
    for (const double share : {0.5, 0.381966, 0.7315}) {
      const double phi = lo + (hi - lo) * share;
      const double value = evaluateNodes(graph_, one, shape_, &phi)[0];
      sign = value > 0 ? 1 : value < 0 ? -1 : 0;
      if (sign != 0) break;
    }
    return sign;
  }

  std::vector<int> frozen(const std::vector<int>& roots, const std::vector<int>& signs) {
    return freezeBranches(graph_, roots, guards_, signs);
  }

  std::shared_ptr<const Program> programFor(const std::vector<int>& signs) {
    std::vector<int> key;
    for (std::size_t k = 0; k < guards_.size(); ++k)
      if (guards_[k].branches()) key.push_back(signs[k]);
    auto& found = programs_[key];
    if (found.first == nullptr) {
      std::vector<int> r = frozen(r_, signs), roots = r;
      for (int order = 0; order < 2; ++order) {
        r = graph_.differentiate(r, 0);
        roots.insert(roots.end(), r.begin(), r.end());
      }
      found.second = {roots[0], roots[1], roots[2]};
      found.first = std::make_shared<const Program>(compileProgram(graph_, roots, static_cast<int>(formula_.text.parameters.size()), 1));
    }
    return found.first;
  }

  /// One side of a boundary.
  struct Side {
    bool valid = false, bounded = true, settled = true;  // settled: r and r_phi have limits
    bool exact = false;                                  // the formula itself has them at the boundary
    CurvePoint limit;
    double edge = 0;   // the last phi at which the formula is evaluated
    double stop = 0;   // where a mass ends if it may not pass
    double slack = 0;  // [m] limits closer than this are one
  };
  CurvePoint at(const Program& program, double phi) const {
    CurvePoint p;
    evaluateCurveProgram(&program, shape_, phi, p);
    return p;
  }
  Side sideOf(const Program& program, double b, double inwards, bool branching) const {
    Side side;
    side.edge = side.stop = b;
    const double width = std::abs(inwards), direction = inwards > 0 ? 1 : -1, unit = std::max(1.0, std::abs(b));
    side.limit = at(program, b);
    const auto inside = [&](double d) { return at(program, b + direction * d); };
    const auto slackOf = [&](const CurvePoint& p) {
      const double move = norm(inside(std::min(0.3 * width, 1.0)).r - p.r);
      return slack(p, b, std::isfinite(move) ? move : 0);
    };
    if (branching && isFinite(side.limit)) {
      // A value there need not be a limit: atan2(0, 0) is 0, or pi.
      const double close = std::min(0.1 * width, 1e-7 * unit);
      const CurvePoint p = inside(close);
      side.slack = slackOf(p);
      side.exact = isFinite(p) && norm(p.r - (direction * close) * p.rPhi - side.limit.r) <= side.slack;
      if (side.exact) {
        side.valid = true;
        return side;
      }
    }
    const double far = std::min(0.1 * width, 1e-5 * unit), near = 0.1 * far, nearer = 0.01 * near;
    const CurvePoint a = inside(far), n = inside(near), m = inside(nearer);
    side.valid = reachlab::isFinite(a.r) && reachlab::isFinite(n.r) && isFinite(inside(0.3 * width));
    if (!side.valid) return side;
    side.edge = b + direction * near;
    side.limit = n;
    side.limit.r -= (direction * near) * n.rPhi;
    const Vec3 fromFar = a.r - (direction * far) * a.rPhi;
    const double size = 1e-3 + norm(n.r);
    side.slack = slackOf(n);
    side.settled = isFinite(n) && norm(fromFar - side.limit.r) <= side.slack;
    const double first = norm(n.r - a.r), then = norm(m.r - n.r);
    // A logarithm gains twice as much over two decades as over one, a power of more than -0.01 less.
    side.bounded = reachlab::isFinite(m.r) && then <= 1.95 * first + 1e-12 * size;
    // As near as phi tells places apart.
    side.stop = side.edge;
    if (side.settled) return side;
    const auto lost = [&](const CurvePoint& p, double d) {
      return !isFinite(p) || norm(p.rPhi) * 2.3e-16 * std::abs(b + direction * d) > std::max(kLost, kFarLost * norm(p.r)) ||
             norm(p.rPhi) > 1e12;
    };
    double d = near;
    while (d < 0.3 * width && lost(inside(d), d)) d *= 2;
    side.stop = b + direction * std::min(d, 0.3 * width);
    for (; d <= near && d > 1e-15 * unit; d *= 0.5) {
      const CurvePoint p = inside(d);
      if (lost(p, d)) break;
      side.stop = b + direction * d;
      if (norm(p.rPhi) * d < 1e-12) break;
    }
    side.edge = side.stop;
    return side;
  }

  void classify() {
    const bool complete = result_.lo == lo_ && result_.hi == hi_;
    if (stretches_.size() == 1 && stretches_[0].guardsAtLo.empty() && atHi_.empty() && complete) {
      result_.whole = true;
      result_.pieces = {{result_.lo, result_.hi, c_.curve}};
      result_.owner = c_.owner;
      addCusps(c_.curve, r_, result_.lo, result_.hi);
      splitNarrow({r_});
      result_.smooth = result_.places.empty();
      return;
    }
    auto programs = std::make_shared<std::vector<std::unique_ptr<PieceProgram>>>();
    result_.owner = programs;
    result_.pieces.clear();
    std::vector<bool> alive;
    for (const Stretch& s : stretches_) {
      auto piece = std::make_unique<PieceProgram>();
      piece->program = programFor(s.signs);
      result_.pieces.push_back({s.lo, s.hi, Curve{evaluatePiece, evaluatePieceBatch, piece.get(), c_.curve.shape}});
      const double width = s.hi - s.lo;
      alive.push_back(isFinite(at(*piece->program, s.lo + 0.5 * width)) || isFinite(at(*piece->program, s.lo + 0.3 * width)));
      programs->push_back(std::move(piece));
    }
    for (std::size_t i = 0; i <= stretches_.size(); ++i) {
      const bool hasLeft = i > 0, hasRight = i < stretches_.size();
      const double b = hasRight ? stretches_[i].lo : stretches_[i - 1].hi;
      std::vector<std::size_t> deciding;
      if (hasRight) deciding = stretches_[i].guardsAtLo;
      for (const auto& [place, guard] : atHi_)
        if (std::abs(place - b) <= 1e-12 * std::max(1.0, std::abs(b))) deciding.push_back(guard);
      if (deciding.empty()) continue;  // the domain's own end, or of what was examined
      bool branching = true;
      for (const std::size_t k : deciding) branching = branching && guards_[k].branches();
      Side left, right;
      if (hasLeft && alive[i - 1])
        left = sideOf(*(*programs)[i - 1]->program, b, -(stretches_[i - 1].hi - stretches_[i - 1].lo), branching);
      if (hasRight && alive[i]) right = sideOf(*(*programs)[i]->program, b, stretches_[i].hi - stretches_[i].lo, branching);
      if (!left.valid && !right.valid) continue;
      branching = branching && (!left.valid || left.exact) && (!right.valid || right.exact);
      Place place;
      place.at = b + 0.0;
      if (!branching && left.valid && right.valid && left.settled && right.settled) {
        // Where an arc touches its end (asin(sin(phi))) the place is known to half its digits: there the two tangents meet.
        const Vec3 turn = left.limit.rPhi - right.limit.rPhi;
        const double miss = -dot(left.limit.r - right.limit.r, turn) / dot(turn, turn);
        if (norm(turn) > 1e-4 * norm(left.limit.rPhi) && std::abs(miss) < kTouching * std::max(1.0, std::abs(b))) {
          place.at += miss;
          left.limit.r += miss * left.limit.rPhi;
          right.limit.r += miss * right.limit.rPhi;
          result_.pieces[i - 1].hi = result_.pieces[i].lo = place.at;
          left.stop += miss;
          right.stop += miss;
        }
      }
      const auto telling = std::find_if(deciding.begin(), deciding.end(), [&](std::size_t k) { return !guards_[k].branches(); });
      const Guard& guard = guards_[telling != deciding.end() ? *telling : deciding.front()];
      place.because = writeFormula(graph_, guard.node, variablesOf(ConstraintKind::Curve), formula_.text.parameters);
      bool seam = false;
      if (!left.valid || !right.valid) {
        const Side& only = left.valid ? left : right;
        place.kind = only.bounded ? PlaceKind::End : PlaceKind::Pole;
        place.r = only.limit.r;
      } else {
        place.r = left.limit.r;
        const double speed = norm(left.limit.rPhi) + norm(right.limit.rPhi);
        if (!left.bounded || !right.bounded) place.kind = PlaceKind::Pole;
        else if (!left.settled || !right.settled) place.kind = PlaceKind::Spike;
        else if (norm(left.limit.r - right.limit.r) > left.slack + right.slack) place.kind = PlaceKind::Jump;
        else if (norm(left.limit.rPhi - right.limit.rPhi) > (branching ? 1e-9 : 1e-4) * speed) place.kind = PlaceKind::Kink;
        else if (!branching) place.kind = PlaceKind::Hole;
        else if (norm(left.limit.rPhiPhi - right.limit.rPhiPhi) > 1e-9 * (norm(left.limit.rPhiPhi) + norm(right.limit.rPhiPhi) + speed))
          place.kind = PlaceKind::Bend;
        else seam = true;
      }
      const bool passed = seam || isPassed(place.kind);
      const int index = seam ? -1 : static_cast<int>(result_.places.size());
      if (!seam) result_.places.push_back(place);
      if (hasLeft) {
        CurvePiece& piece = result_.pieces[i - 1];
        piece.placeAtHi = index;
        piece.passedAtHi = passed && hasRight;
        if (!branching) (*programs)[i - 1]->hi = left.edge;
        if (!passed && !branching) piece.hi = left.stop;
      }
      if (hasRight) {
        CurvePiece& piece = result_.pieces[i];
        piece.placeAtLo = index;
        piece.passedAtLo = passed && hasLeft;
        if (!branching) (*programs)[i]->lo = right.edge;
        if (!passed && !branching) piece.lo = right.stop;
      }
    }
    result_.whole = false;
    const std::vector<CurvePiece> all = result_.pieces;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (alive[i]) {
        const auto& r = programs_.at(keyOf(stretches_[i].signs)).second;
        addCusps(all[i].curve, {r[0], r[1], r[2]}, all[i].lo, all[i].hi);
      }
    result_.pieces.clear();
    std::vector<std::vector<int>> formulas;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (alive[i]) {
        result_.pieces.push_back(all[i]);
        const auto& r = programs_.at(keyOf(stretches_[i].signs)).second;
        formulas.push_back({r[0], r[1], r[2]});
      }
    splitNarrow(formulas);
    // Cusps were added behind: in order again, and the pieces' indices with them.
    std::vector<std::size_t> order(result_.places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return result_.places[a].at < result_.places[b].at; });
    std::vector<Place> sorted;
    std::vector<int> where(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) where[order[i]] = static_cast<int>(i), sorted.push_back(result_.places[order[i]]);
    result_.places = std::move(sorted);
    for (CurvePiece& piece : result_.pieces)
      for (int* index : {&piece.placeAtLo, &piece.placeAtHi})
        if (*index >= 0) *index = where[static_cast<std::size_t>(*index)];
    result_.smooth = result_.places.empty();
  }

  std::vector<int> keyOf(const std::vector<int>& signs) const {
    std::vector<int> key;
    for (std::size_t k = 0; k < guards_.size(); ++k)
      if (guards_[k].branches()) key.push_back(signs[k]);
    return key;
  }

  /// Places where r_phi vanishes.
  void addCusps(const Curve& curve, const std::vector<int>& r, double lo, double hi) {
    if (!(lo < hi) || !stillPlaces_) return;
    const std::vector<int> d = graph_.differentiate(r, 0);
    int square = graph_.powInt(d[0], 2);
    for (int k = 1; k < 3; ++k) square = graph_.add(square, graph_.powInt(d[static_cast<std::size_t>(k)], 2));
    const double widest = std::max(1.0, hi - lo);
    for (const double phi : findRoots(graph_, square, shape_, lo, hi, boxes_).roots) {
      if (result_.places.size() >= kMaxPlaces) return;
      const double step = std::min(1e-4, 1e-3 * widest);
      const auto speed = [&](double q) { return norm(evaluate(curve, q).rPhi); };
      double around = 0;
      for (const double d10 : {1.0, 10.0, 100.0})
        for (const double side : {-1.0, 1.0})
          if (const double s = speed(std::clamp(phi + side * d10 * step, lo, hi)); std::isfinite(s)) around = std::max(around, s);
      if (!(speed(phi) <= 1e-7 * around)) continue;
      Place place;
      place.at = phi + 0.0;
      place.r = evaluate(curve, phi).r;
      place.because = "r_phi = 0";
      const CurvePoint before = evaluate(curve, phi - step), after = evaluate(curve, phi + step);
      const double turn = dot(before.rPhi, after.rPhi) / (norm(before.rPhi) * norm(after.rPhi));
      const bool same = norm(before.r - after.r) <= 1e-9 * norm(after.r - place.r) + 1e-18;
      place.kind = turn > 0 ? PlaceKind::Standstill : same ? PlaceKind::Fold : PlaceKind::Cusp;
      result_.places.push_back(place);
    }
  }

  /// Stretches on which the curve bends much more than elsewhere and that are shorter than a tick's way: pieces of their own, so that a
  /// step lands on them and goes through in small parts. `formulas`: r of each piece.
  void splitNarrow(const std::vector<std::vector<int>>& formulas) {
    constexpr std::size_t kMost = 64;
    constexpr int kSamples = 257, kBoxesForThem = 20000;
    if (!stillPlaces_ || c_.curve.function != evaluateCurveProgram) return;  // a definition of the catalogue is known
    const auto [from, to] = window(lo_, hi_, 1.0 / 4);
    std::vector<CurvePiece> parts;
    std::size_t count = 0;
    int boxes = kBoxesForThem;
    for (std::size_t k = 0; k < result_.pieces.size(); ++k) {
      const CurvePiece& piece = result_.pieces[k];
      const double lo = std::max(piece.lo, from), hi = std::min(piece.hi, to);
      std::vector<double> speeds, bends;
      const double first = std::max(lo, about_ - std::numbers::pi), last = std::min(hi, about_ + std::numbers::pi);
      for (int i = 0; i < kSamples && first < last; ++i) {
        const CurvePoint p = evaluate(piece.curve, first + (last - first) * (i + 0.5) / kSamples);
        if (!isFinite(p)) continue;
        speeds.push_back(norm(p.rPhi));
        bends.push_back(norm(p.rPhiPhi));
      }
      if (speeds.empty()) {
        parts.push_back(piece);
        continue;
      }
      const auto median = [](std::vector<double>& all) {
        std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
        return all[all.size() / 2];
      };
      const double speed = median(speeds), usual = speed + median(bends);
      std::vector<int> d = graph_.differentiate(graph_.differentiate(formulas[k], 0), 0);
      int excess = graph_.constant(-narrow::kMuch * narrow::kMuch * usual * usual);
      for (const int bend : d) excess = graph_.add(excess, graph_.powInt(bend, 2));
      const RootSearch search = findRoots(graph_, excess, shape_, lo, hi, boxes);
      std::vector<std::pair<double, double>> narrow;
      for (std::size_t i = 0; i + 1 < search.roots.size(); ++i) {
        const double a = search.roots[i], b = search.roots[i + 1];
        const std::vector<int> one{excess};
        const double middle = a + (b - a) / 2;
        if (!(evaluateNodes(graph_, one, shape_, &middle)[0] > 0) || !((b - a) * speed < narrow::kWay)) continue;
        const double more = 0.25 * (b - a);
        if (!narrow.empty() && a - narrow.back().second < 4 * more + 2 * (narrow.back().second - narrow.back().first))
          narrow.back().second = b + more;
        else narrow.push_back({a - more, b + more});
      }
      count += narrow.size();
      CurvePiece rest = piece;
      for (const auto& [a, b] : narrow) {
        if (!(a > rest.lo && b < rest.hi)) continue;
        CurvePiece before = rest, within = rest;
        before.hi = within.lo = a;
        within.hi = rest.lo = b;
        before.placeAtHi = within.placeAtLo = within.placeAtHi = rest.placeAtLo = -1;
        before.passedAtHi = within.passedAtLo = within.passedAtHi = rest.passedAtLo = true;
        within.narrow = true;
        parts.push_back(before);
        parts.push_back(within);
      }
      parts.push_back(rest);
    }
    if (parts.size() == result_.pieces.size() || count > kMost) return;
    result_.pieces = std::move(parts);
    result_.whole = false;
  }

  const Constraint& c_;
  const CompiledFormula& formula_;
  ExpressionGraph graph_;
  const double* shape_;
  double about_, lo_ = 0, hi_ = 0;
  bool stillPlaces_ = true;
  int boxes_ = kMaxBoxes;  // for places where r_phi = 0
  std::vector<int> r_;
  std::vector<Guard> guards_;
  std::vector<Stretch> stretches_;
  std::vector<std::pair<double, std::size_t>> atHi_;
  std::map<std::vector<int>, std::pair<std::shared_ptr<const Program>, std::array<int, 3>>> programs_;
  CurveRegularity result_;
};

}  // namespace

const char* nameOf(PlaceKind kind) {
  static constexpr const char* kNames[] = {"kink", "bend", "hole", "jump", "pole", "end", "spike", "cusp", "fold", "standstill"};
  return kNames[static_cast<int>(kind)];
}

bool isPassed(PlaceKind kind) {
  return kind != PlaceKind::Jump && kind != PlaceKind::Pole && kind != PlaceKind::End && kind != PlaceKind::Spike;
}

std::string describe(const Place& place, ConstraintKind kind) {
  const char* name = kind == ConstraintKind::Curve ? "phi" : place.parameter == 0 ? "u" : "v";
  return place.parameter < 0 ? fmt::format("{} along {} = 0", nameOf(place.kind), place.because)
                             : fmt::format("{} at {} = {:.9g}: {}", nameOf(place.kind), name, place.at, place.because);
}

int CurveRegularity::pieceAt(double phi) const {
  for (std::size_t i = pieces.size(); i-- > 0;)
    if (phi >= pieces[i].lo && phi <= pieces[i].hi) return static_cast<int>(i);
  return -1;
}

CurveRegularity computeRegularity(const Constraint& curve, double about) {
  if (curve.kind != ConstraintKind::Curve || curve.owner == nullptr) return {};
  return Examiner(curve, about).examine();
}

CurveRegularity computeRegularityWithin(const Constraint& curve, double lo, double hi) {
  if (curve.kind != ConstraintKind::Curve || curve.owner == nullptr) return {};
  return Examiner(curve, lo + (hi - lo) / 2).examine(lo, hi, false);
}

std::vector<Place> placesBetween(const CurveRegularity& regularity, double from, double to) {
  std::vector<Place> between;
  for (const Place& place : regularity.places)
    if (place.at > std::min(from, to) && place.at < std::max(from, to)) between.push_back(place);
  return between;
}

}  // namespace reachlab::constraints
