#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "constraints/formula/formula.h"
#include "constraints/formula/guards.h"
#include "constraints/formula/interval.h"
#include "constraints/formula/roots.h"
#include "constraints/regularity/branch_curve.h"
#include "constraints/regularity/curve_search.h"
#include "constraints/regularity/period.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {
namespace {

constexpr double kTurns = 64 * 2 * std::numbers::pi;
constexpr double kReach = 10;         // [m] that are examined at least either way
constexpr double kLargestPhi = 1e12;  // at most
constexpr double kProvedShare =
    1.0 / 16;  // of that, for still places of a formula that is analytic everywhere: others are met in the motion
constexpr std::size_t kMaxPlaces = 2000;
constexpr int kMaxBoxes = 100000;    // stretches looked at: tenths of a second
constexpr double kTouching = 1e-7;   // a root or an arc that touches the end of its domain has lost half its digits there
constexpr double kTogether = 1e-12;  // of phi, at least 1: boundaries nearer to each other are one
constexpr double kSameTangent = 1e-9, kSameLimit = 1e-4;  // of |r_phi|: of the formula's own values, and of limits from three places

bool lieTogether(double a, double b) { return std::abs(a - b) <= kTogether * std::max(1.0, std::abs(b)); }

class Examiner {
 public:
  Examiner(const Constraint& c, double about)
      : c_(c), formula_(*c.formula), graph_(formula_.graph), shape_(c.shape()), about_(about),
        r_(formula_.place().begin(), formula_.place().end()), guards_(findGuards(graph_, r_, shape_)) {}

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
      result_.lo = lo;
      result_.hi = hi;
      const bool bounded = std::isfinite(lo) && std::isfinite(hi);
      const auto [from, to] = window(lo, hi, bounded ? 1 : kProvedShare);
      takeWhole(from, to);
      return std::move(result_);
    }
    for (double share = 1; share > 1e-7; share /= 16) {
      if (!split(lo, hi, share)) continue;
      const bool complete = result_.lo == lo_ && result_.hi == hi_;
      if (complete && stretches_.size() == 1 && stretches_[0].guardsAtLo.empty() && atHi_.empty()) takeWhole(lo, hi);
      else takePieces();
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
      IntervalEvaluator bounds(graph_, std::span(&g.argument, 1), shape_);
      bounds.evaluate({Interval{lo, hi}, Interval{}});
      const Interval range = bounds.rangeOf(0);
      if (g.op == Op::Atan2) {  // its cut lies where x < 0
        IntervalEvaluator right(graph_, std::span(&graph_.node(g.node).b, 1), shape_);
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
    const double infinity = std::numeric_limits<double>::infinity();
    result_.places.push_back({.kind = PlaceKind::End, .at = direction * infinity, .r = last, .because = "r comes to rest"});
  }

  /// Where a curve comes to rest, nothing is stepped over on its last millimetre.
  void seeFarEnds() {
    constexpr double kLast = 1e-3;  // [m]
    for (const Place& place : result_.places) {
      double& seen = place.at < 0 ? result_.seenLo : result_.seenHi;
      if (std::isinf(place.at) && std::isfinite(seen) && norm(evaluate(c_.curve, seen).r - place.r) < kLast) seen = place.at;
    }
  }

  std::pair<double, double> window(double lo, double hi, double share) const {
    double half = kTurns;
    if (const double speed = norm(evaluate(c_.curve, about_).rPhi); speed > 0 && std::isfinite(speed))
      half = std::max(half, kReach / speed);
    half = std::min(half, kLargestPhi) * share;
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
        const RootSearch search = findRoots(graph_, g, shape_, s.lo, s.hi, boxes, guards_[k].branches() ? kTogether : kTouching);
        if (search.examinedTo < s.hi && s.lo <= about_ + 1e-9) return false;
        double from = s.lo;
        std::vector<std::size_t> guardsAtFrom = s.guardsAtLo;
        const double near = kTogether * std::max({1.0, std::abs(s.lo), std::abs(s.hi)});
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
    int sign = 0;
    for (const double share : {0.5, 0.381966, 0.7315}) {
      const double phi = lo + (hi - lo) * share;
      const double value = evaluateNode(graph_, g, shape_, &phi);
      sign = value > 0 ? 1 : value < 0 ? -1 : 0;
      if (sign != 0) break;
    }
    return sign;
  }

  std::vector<int> frozen(const std::vector<int>& roots, const std::vector<int>& signs) {
    return freezeBranches(graph_, roots, guards_, signs);
  }

  /// What is evaluated where the guards have these signs: one for all stretches whose branching guards agree.
  struct Branch {
    std::shared_ptr<const Program> program;
    std::vector<int> r;  // its nodes
  };
  const Branch& branchFor(const std::vector<int>& signs) {
    std::vector<int> key;
    for (std::size_t k = 0; k < guards_.size(); ++k)
      if (guards_[k].branches()) key.push_back(signs[k]);
    Branch& found = branches_[key];
    if (found.program == nullptr) {
      found.r = frozen(r_, signs);
      const std::vector<int> roots = withDerivatives(graph_, found.r, ConstraintKind::Curve);
      found.program = std::make_shared<const Program>(compileProgram(graph_, roots, static_cast<int>(formula_.text.parameters.size()), 1));
    }
    return found;
  }

  /// The formula is analytic throughout: one piece, with its still places from phi = `from` to `to`.
  void takeWhole(double from, double to) {
    result_.whole = true;
    result_.pieces = {{result_.lo, result_.hi, c_.curve}};
    result_.owner = c_.formula;
    addStillPlaces({r_, c_.curve, from, to});
    addNarrowPlaces({r_});
    if (!c_.domain[0].periodic) {
      if (!std::isfinite(result_.lo)) addFarEnd(-1);
      if (!std::isfinite(result_.hi)) addFarEnd(1);
      seeFarEnds();
    }
    result_.smooth = result_.places.empty();
  }

  /// A piece for each stretch on which the formula has a value, and the places between them.
  void takePieces() {
    makePieces();
    for (std::size_t i = 0; i <= stretches_.size(); ++i) examineBoundary(i);
    std::vector<std::vector<int>> formulas;
    std::vector<CurvePiece> alive;
    for (std::size_t i = 0; i < stretches_.size(); ++i) {
      if (!alive_[i]) continue;
      const CurvePiece& piece = result_.pieces[i];
      formulas.push_back(branchFor(stretches_[i].signs).r);
      addStillPlaces({formulas.back(), piece.curve, piece.lo, piece.hi});
      alive.push_back(piece);
    }
    result_.whole = false;
    result_.pieces = std::move(alive);
    addNarrowPlaces(formulas);
    sortPlaces();
    result_.smooth = result_.places.empty();
  }
  void makePieces() {
    curves_ = std::make_shared<std::vector<std::unique_ptr<BranchCurve>>>();
    result_.owner = curves_;
    result_.pieces.clear();
    for (const Stretch& s : stretches_) {
      auto branch = std::make_unique<BranchCurve>();
      branch->program = branchFor(s.signs).program;
      result_.pieces.push_back({s.lo, s.hi, curveOf(*branch, c_.curve)});
      const double width = s.hi - s.lo;
      const auto hasValue = [&](double share) { return isFinite(evaluate(result_.pieces.back().curve, s.lo + share * width)); };
      alive_.push_back(hasValue(0.5) || hasValue(0.3));
      curves_->push_back(std::move(branch));
    }
  }

  /// A place between two pieces, as it is being examined.
  struct Boundary {
    double at = 0;
    std::vector<std::size_t> guards;  // that decide there
    bool branching = true;            // all of them branch, and the formula itself has its limits there
    BranchEnd left, right;
    bool seam = false;  // no place at all: r, r_phi and r_phiphi run on
  };
  /// The one below stretch `i`, where something decides there: else it is the domain's own end, or of what was examined.
  void examineBoundary(std::size_t i) {
    const bool hasLeft = i > 0, hasRight = i < stretches_.size();
    Boundary b;
    b.at = hasRight ? stretches_[i].lo : stretches_[i - 1].hi;
    b.guards = guardsAt(i, b.at);
    if (b.guards.empty()) return;
    for (const std::size_t k : b.guards) b.branching = b.branching && guards_[k].branches();
    if (hasLeft && alive_[i - 1]) b.left = endOf(i - 1, b, -1);
    if (hasRight && alive_[i]) b.right = endOf(i, b, 1);
    if (!b.left.valid && !b.right.valid) return;
    // At an end of the examined range nothing lies behind, so that only an end without a limit is a place.
    const BranchEnd& only = b.left.valid ? b.left : b.right;
    if (!(hasLeft && hasRight) && only.settled && only.bounded &&
        isFinite(evaluate((hasLeft ? result_.pieces[i - 1] : result_.pieces[i]).curve, b.at)))
      return;
    if (!b.branching) blind_.push_back(b.at);
    b.branching = b.branching && (!b.left.valid || b.left.exact) && (!b.right.valid || b.right.exact);
    Place place;
    place.at = b.at + 0.0 + moveToTangents(i, b);
    place.because = writeFormula(graph_, tellingGuard(b).node, variablesOf(ConstraintKind::Curve), formula_.text.parameters);
    place.r = b.left.valid ? b.left.limit.r : b.right.limit.r;
    place.kind = kindOf(b);
    const bool passed = b.seam || isPassed(place.kind);
    const int index = b.seam ? -1 : static_cast<int>(result_.places.size());
    if (!b.seam) result_.places.push_back(place);
    if (hasLeft) {
      CurvePiece& piece = result_.pieces[i - 1];
      piece.placeAtHi = index;
      piece.passedAtHi = passed && hasRight;
      if (!b.branching) (*curves_)[i - 1]->hi = b.left.edge;
      if (!passed && !b.branching) piece.hi = b.left.stop;
    }
    if (hasRight) {
      CurvePiece& piece = result_.pieces[i];
      piece.placeAtLo = index;
      piece.passedAtLo = passed && hasLeft;
      if (!b.branching) (*curves_)[i]->lo = b.right.edge;
      if (!passed && !b.branching) piece.lo = b.right.stop;
    }
  }
  std::vector<std::size_t> guardsAt(std::size_t i, double at) const {
    std::vector<std::size_t> deciding;
    if (i < stretches_.size()) deciding = stretches_[i].guardsAtLo;
    for (const auto& [place, guard] : atHi_)
      if (lieTogether(place, at)) deciding.push_back(guard);
    return deciding;
  }
  BranchEnd endOf(std::size_t i, const Boundary& b, double direction) const {
    return examineEnd(*(*curves_)[i]->program, shape_, b.at, direction * (stretches_[i].hi - stretches_[i].lo), b.branching);
  }
  /// Where an arc touches its end (asin(sin(phi))) the place is known to half its digits: there the two tangents meet. By how much it moves.
  double moveToTangents(std::size_t i, Boundary& b) {
    if (b.branching || !b.left.valid || !b.right.valid || !b.left.settled || !b.right.settled) return 0;
    const Vec3 turn = b.left.limit.rPhi - b.right.limit.rPhi;
    const double miss = -dot(b.left.limit.r - b.right.limit.r, turn) / dot(turn, turn);
    if (!(norm(turn) > kSameLimit * norm(b.left.limit.rPhi) && std::abs(miss) < kTouching * std::max(1.0, std::abs(b.at)))) return 0;
    for (BranchEnd* end : {&b.left, &b.right}) {
      end->limit.r += miss * end->limit.rPhi;
      end->stop += miss;
    }
    result_.pieces[i - 1].hi = result_.pieces[i].lo = b.at + 0.0 + miss;
    return miss;
  }
  /// What a person is told of: one that does not only branch, if there is one.
  const Guard& tellingGuard(const Boundary& b) const {
    const auto telling = std::find_if(b.guards.begin(), b.guards.end(), [&](std::size_t k) { return !guards_[k].branches(); });
    return guards_[telling != b.guards.end() ? *telling : b.guards.front()];
  }
  static PlaceKind kindOf(Boundary& b) {
    const BranchEnd &left = b.left, &right = b.right;
    if (!left.valid || !right.valid) return (left.valid ? left : right).bounded ? PlaceKind::End : PlaceKind::Pole;
    const double speed = norm(left.limit.rPhi) + norm(right.limit.rPhi);
    if (!left.bounded || !right.bounded) return PlaceKind::Pole;
    if (!left.settled || !right.settled) return PlaceKind::Spike;
    if (norm(left.limit.r - right.limit.r) > left.slack + right.slack) return PlaceKind::Jump;
    if (norm(left.limit.rPhi - right.limit.rPhi) > (b.branching ? kSameTangent : kSameLimit) * speed) return PlaceKind::Kink;
    if (!b.branching) return PlaceKind::Hole;
    if (norm(left.limit.rPhiPhi - right.limit.rPhiPhi) > kSameTangent * (norm(left.limit.rPhiPhi) + norm(right.limit.rPhiPhi) + speed))
      return PlaceKind::Bend;
    b.seam = true;
    return {};
  }

  void addStillPlaces(const CurveStretch& stretch) {
    if (!stillPlaces_ || result_.places.size() >= kMaxPlaces) return;
    for (Place& place : findStillPlaces(graph_, shape_, stretch, boxes_, kMaxPlaces - result_.places.size()))
      result_.places.push_back(std::move(place));
  }
  /// What lies beyond the range in which narrow places are known is cut off where it matters: on curves that are passed piece by piece.
  void addNarrowPlaces(const std::vector<std::vector<int>>& formulas) {
    if (!stillPlaces_ || c_.curve.function != evaluateCurveProgram) return;  // a definition of the catalogue is known
    if (result_.pieces.empty()) return;
    const auto [from, to] = window(lo_, hi_, 1);
    NarrowSearch found = findNarrowPlaces(graph_, shape_, result_.pieces, formulas, blind_, {from, to}, about_, findPeriod(c_).turn);
    result_.narrow = std::move(found.places);
    result_.seenLo = found.lo;
    result_.seenHi = found.hi;
    result_.whole = result_.whole && result_.narrow.empty();
    if (result_.whole) return;
    std::erase_if(result_.pieces, [&](const CurvePiece& piece) { return piece.hi <= found.lo || piece.lo >= found.hi; });
    if (result_.pieces.empty()) return;
    CurvePiece &first = result_.pieces.front(), &last = result_.pieces.back();
    if (first.lo < found.lo) first.lo = found.lo, first.placeAtLo = -1, first.passedAtLo = false;
    if (last.hi > found.hi) last.hi = found.hi, last.placeAtHi = -1, last.passedAtHi = false;
  }
  /// In order of phi, and the pieces' indices with them: still places were added behind.
  void sortPlaces() {
    std::vector<std::size_t> order(result_.places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return result_.places[a].at < result_.places[b].at; });
    std::vector<Place> sorted;
    std::vector<int> where(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) where[order[i]] = static_cast<int>(i), sorted.push_back(result_.places[order[i]]);
    result_.places = std::move(sorted);
    for (CurvePiece& piece : result_.pieces)
      for (int* index : {&piece.placeAtLo, &piece.placeAtHi})
        if (*index >= 0) *index = where[*index];
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
  std::map<std::vector<int>, Branch> branches_;
  std::shared_ptr<std::vector<std::unique_ptr<BranchCurve>>> curves_;  // of the stretches
  std::vector<double> blind_;                                          // where a guard decides that does not branch
  std::vector<bool> alive_;                                            // whether a stretch's formula has a value
  CurveRegularity result_;
};

}  // namespace

CurveRegularity computeRegularity(const Constraint& curve, double about) {
  if (curve.kind != ConstraintKind::Curve || curve.formula == nullptr) return {};
  return Examiner(curve, about).examine();
}

CurveRegularity computeRegularityWithin(const Constraint& curve, double lo, double hi) {
  if (curve.kind != ConstraintKind::Curve || curve.formula == nullptr) return {};
  return Examiner(curve, lo + (hi - lo) / 2).examine(lo, hi, false);
}

}  // namespace reachlab::constraints
