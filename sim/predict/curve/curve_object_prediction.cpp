#include "sim/predict/curve/path_predictions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/fault.h"
#include "base/math/eigen_solvers.h"
#include "sim/predict/curve/curve_motion.h"
#include "sim/predict/line/modes.h"
#include "sim/predict/transcription/transcription.h"

namespace reachlab::predict {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int kMostNewtonSteps = 25;
constexpr int kMostUnknowns = 300, kMaxIntervals = 4000;
constexpr double kCurveSettled = 3e-6;  // change of the unknowns, relative: Newton's error is its square
constexpr double kLeastError = 1e-12;   // of the profile, of its peak: rounding
constexpr double kCurveProfile = 2e-9;  // error of the profile, of its peak, that is aimed at
constexpr double kArrived = 1e-11;      // of the way, by any mass on the finer intervals
constexpr double kEndRounding = 1e-9;   // of the way, beyond the end of a curve whose target is its end
constexpr double kIntervalPhase = 2.5;  // fastest rate times the width of a interval
constexpr int kFinerIntervals = 4;
constexpr double kUnknownsPerPhase = 0.45;  // fewer do not follow the fastest mode of the object
constexpr double kMinBend = 1.0 / 64;       // step of the continuation from the straight line below which it is given up

// What the masses must meet at T, each condition in the same unit: clamped modes and their rates (docs/theory/criteria.md, "Pontryagin's
// conditions").
Matrix makeConditionScale(const LineObject& object) {
  const Modes modes = computeClampedModes(object);
  const int n = object.count();
  const Matrix project = modes.shape.bottomRows(n).transpose() * Eigen::Map<const Vector>(object.masses.data(), n).asDiagonal();
  Matrix scale = Matrix::Zero(2 * n, 2 * n);
  scale.topLeftCorner(n, n) = modes.frequency.asDiagonal() * project;
  scale.bottomRightCorner(n, n) = project;
  return scale;
}

struct HandTable {
  Matrix position, speed;            // of every unknown at every node
  Vector fixedPosition, fixedSpeed;  // of the ends alone
};

HandTable tabulateHand(const RestToRestBasis& basis, const CurveMotion& motion, double length, double duration) {
  const int unknowns = basis.columns() - 1, width = basis.order() + 1;
  HandTable table{Matrix(motion.nodes(), unknowns), Matrix(motion.nodes(), unknowns), Vector(motion.nodes()), Vector(motion.nodes())};
  Matrix at(width, basis.columns());
  for (int node = 0; node < motion.nodes(); ++node) {
    basis.tabulate(2 * motion.timeOf(node) / duration - 1, 2 / duration, at.data());
    table.position.row(node) = at.row(0).tail(unknowns);
    table.speed.row(node) = at.row(1).tail(unknowns);
    table.fixedPosition(node) = length * at(0, 0);
    table.fixedSpeed(node) = length * at(1, 0);
  }
  return table;
}

struct Optimum {
  RestToRestBasis basis;
  Vector unknowns, multiplier;
  double cost = 0, condition = 0;
};

class Search {
 public:
  Search(const constraints::ArcCurve& curve, const LineObject& object, double duration, const std::shared_ptr<WorkLimit>& work)
      : curve_(curve), duration_(duration), object_(object), problem_(makeCurveJerkProblem(curve, duration)),
        scale_(makeConditionScale(object)), target_(2 * object.count()) {
    problem_.work = work;
    target_ << Vector::Constant(object.count(), curve.length()), Vector::Zero(object.count());
  }

  Optimum solve(int unknowns, int intervals, const Vector& guess, const Vector& multiplier) const;
  /// Follows the optimum on finer intervals.
  CurveMotion follow(const Optimum& optimum, int intervals) const;
  double missOf(const CurveMotion& motion) const { return (motion.end() - target_).head(object_.count()).lpNorm<Eigen::Infinity>(); }
  double fastest() const { return boundRate(object_); }

 private:
  const constraints::ArcCurve& curve_;
  double duration_;
  const LineObject& object_;
  TranscribedProblem problem_;
  Matrix scale_;
  Vector target_;
};

Optimum Search::solve(int unknowns, int intervals, const Vector& guess, const Vector& multiplier) const {
  const double n = object_.count(), stage = CurveMotion::kStages * n, nodes = 1.0 * intervals * CurveMotion::kStages;
  const double followed = intervals * (stage * stage * stage + 1e3 * stage), turned = 2 * (n + 1) * nodes * unknowns;
  const double stepped = intervals * stage * stage * unknowns + turned * (4 * n + unknowns / 2.0) + 3 * std::pow(unknowns, 3);
  WorkLimit::hold(2 * turned + intervals * 2 * stage * stage + 4.0 * unknowns * unknowns);
  Optimum found{RestToRestBasis(problem_.order, unknowns), Vector::Zero(unknowns), multiplier};
  found.unknowns.head(std::min<Eigen::Index>(guess.size(), unknowns)) = guess.head(std::min<Eigen::Index>(guess.size(), unknowns));
  const TranscribedCost cost(problem_, found.basis);
  CurveMotion motion(curve_, object_, duration_, intervals);
  const HandTable hand = tabulateHand(found.basis, motion, curve_.length(), duration_);
  const auto follow = [&](const Vector& c) {
    problem_.work->spend(followed + 2 * nodes * unknowns);
    return motion.follow(hand.fixedPosition + hand.position * c, hand.fixedSpeed + hand.speed * c);
  };
  const auto refuse = [&] { throw RefusedError("the object cannot follow the hand: springs would turn over on a way that is so bent"); };
  if (!follow(found.unknowns)) refuse();
  const int conditions = static_cast<int>(target_.size());
  Vector gradient;
  Matrix hessian;
  double size = 0, miss = 0;
  for (int iteration = 1; iteration <= kMostNewtonSteps; ++iteration) {
    problem_.work->spend(stepped);
    found.cost = cost.expand(found.unknowns, gradient, hessian);
    const Vector off = scale_ * (motion.end() - target_);
    const Matrix slope = scale_ * motion.linearise(hand.position, hand.speed);
    if (found.multiplier.size() > 0) hessian += motion.computeHessian(scale_.transpose() * found.multiplier);

    // Range and null space of the conditions by QR: what is met, and what is free.
    const Eigen::HouseholderQR<Matrix> qr(slope.transpose());
    const Matrix q = qr.householderQ();
    const Matrix r = qr.matrixQR().topRows(conditions).triangularView<Eigen::Upper>();
    const auto range = q.leftCols(conditions), freedom = q.rightCols(unknowns - conditions);
    const Vector meet = range * r.transpose().triangularView<Eigen::Lower>().solve(-off);
    const Matrix reduced = freedom.transpose() * hessian * freedom;
    double damping = 0;
    Eigen::LLT<Matrix> factor(reduced);
    while (factor.info() != Eigen::Success) {  // not convex here
      damping = std::max(10 * damping, 1e-4 * reduced.diagonal().cwiseAbs().maxCoeff());
      factor.compute(reduced + damping * Matrix::Identity(reduced.rows(), reduced.cols()));
    }
    const Vector step = meet - freedom * factor.solve(freedom.transpose() * (gradient + hessian * meet));
    found.multiplier = r.triangularView<Eigen::Upper>().solve(-range.transpose() * (gradient + hessian * step));

    // Shorter where the object would not follow, or miss the target by far more than before.
    size = step.norm(), miss = off.norm();
    const double small = kCurveSettled * (found.unknowns.norm() + 1e-3 * curve_.length());
    double length = 1;
    while (
        !(follow(found.unknowns + length * step) && (scale_ * (motion.end() - target_)).norm() <= 2 * miss + 0.1 * std::sqrt(found.cost))) {
      length /= 2;
      if (length < 1e-3) refuse();
    }
    found.unknowns += length * step;
    if (damping == 0 && length == 1 && size <= small) {
      found.cost = cost.evaluate(found.unknowns);
      const Vector columns = r.colwise().norm().cwiseInverse();
      const Vector sizes = singularValues(r * columns.asDiagonal());
      found.condition = sizes(0) / sizes(conditions - 1);
      return found;
    }
  }
  throw RefusedError(
      fmt::format("no minimum was found within {} steps with {} unknowns (last step {:.1e} of the motion, conditions missed by "
                  "{:.1e}); a longer time or a less bent way may help",
                  kMostNewtonSteps, unknowns, size / found.unknowns.norm(), miss));
}

CurveMotion Search::follow(const Optimum& optimum, int intervals) const {
  CurveMotion motion(curve_, object_, duration_, intervals);
  const HandTable hand = tabulateHand(optimum.basis, motion, curve_.length(), duration_);
  if (!motion.follow(hand.fixedPosition + hand.position * optimum.unknowns, hand.fixedSpeed + hand.speed * optimum.unknowns))
    throw RefusedError("the object cannot follow the hand along this curve: its springs would turn over");
  return motion;
}

// The optimum on the straight line, then on the curve: at once, or by parts of it where that does not settle.
Optimum continueFromStraight(const constraints::ArcCurve& curve, const LineObject& object, double duration, int unknowns, int intervals,
                             const std::shared_ptr<WorkLimit>& work) {
  const auto solve = [&](double part, const Vector& guess, const Vector& multiplier) {
    const constraints::ArcCurve bent = curve.magnified(part);
    return Search(bent, object, duration, work).solve(unknowns, intervals, guess, multiplier);
  };
  Optimum best = solve(0, {}, {});
  double part = 0;
  for (double step = 1; part < 1;) {
    const double next = std::min(1.0, part + step);
    try {
      best = solve(next, best.unknowns, best.multiplier);
      part = next;
    } catch (const RefusedError& refused) {
      step /= 4;
      if (step < kMinBend)
        throw RefusedError(fmt::format("the straight line could be bent only to {:.0f} % of the way: {}", 100 * part, refused.what()));
    }
  }
  return best;
}

class CurveObjectPrediction final : public Prediction {
 public:
  CurveObjectPrediction(MotionSeries hand, PiecewiseSeries masses, std::vector<int> source, double seconds, double fastest)
      : hand_(std::move(hand)), masses_(std::move(masses)), source_(std::move(source)) {
    duration = seconds;
    massCount_ = static_cast<int>(source_.size());
    fastest_ = std::max(fastest, static_cast<double>(hand_.position.size()) / seconds);
  }
  PredictedHand handAt(double t) const override {
    const double x = 2 * t / duration - 1;
    return {valueAt(hand_.position, x), valueAt(hand_.velocity, x), valueAt(hand_.acceleration, x)};
  }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    for (size_t i = 0; i < source_.size(); ++i) {
      const PredictedHand mass = masses_.evaluate(source_[i], t);
      position[i] = mass.position, velocity[i] = mass.velocity;
    }
  }

 private:
  MotionSeries hand_;
  PiecewiseSeries masses_;
  std::vector<int> source_;
};

MotionSeries seriesOf(const Optimum& optimum, double length, double duration) {
  std::vector<double> all{length};
  all.insert(all.end(), optimum.unknowns.begin(), optimum.unknowns.end());
  MotionSeries hand{optimum.basis.combine(all, 0), optimum.basis.combine(all, 1), optimum.basis.combine(all, 2)};
  for (double& c : hand.velocity) c *= 2 / duration;
  for (double& c : hand.acceleration) c *= 4 / (duration * duration);
  return hand;
}

// Change of the hand's velocity from one to the other, of its peak.
double compare(const LegendreSeries& coarse, const LegendreSeries& fine) {
  constexpr int kProbes = 100;
  double change = 0, peak = 0;
  for (int i = 0; i <= kProbes; ++i) {
    const double x = 2.0 * i / kProbes - 1, v = valueAt(fine, x);
    peak = std::max(peak, std::abs(v));
    change = std::max(change, std::abs(v - valueAt(coarse, x)));
  }
  return change / peak;
}

}  // namespace

std::unique_ptr<Prediction> makeCurveObjectPrediction(const constraints::ArcCurve& curve, const LineObject& object, double duration,
                                                      int unknowns) {
  const auto work = std::make_shared<WorkLimit>();
  const Search search(curve, object, duration, work);
  const int conditions = 2 * object.count();
  const double phase = search.fastest() * duration;
  double asked = std::max(8.0, phase / kIntervalPhase);
  if (asked > kMaxIntervals)
    throw RefusedError(fmt::format("the object is too fast for the movement time: {:.3g} rad/s for {:.3g} s; allowed: a product of {}",
                                   search.fastest(), duration, kMaxIntervals * kIntervalPhase));
  int intervals = static_cast<int>(std::ceil(asked));
  int n = unknowns > 0 ? unknowns : std::max(conditions + 14, static_cast<int>(kUnknownsPerPhase * phase));
  if (n <= conditions)
    throw FaultError(Fault{"unknowns", fmt::format("are {}", n), fmt::format("more than {} here, twice the number of masses", conditions)});

  Optimum best = continueFromStraight(curve, object, duration, n, intervals, work);
  MotionSeries hand = seriesOf(best, curve.length(), duration);
  double error = 0, before = 0, bound = 0;
  if (unknowns > 0) {
    const Optimum finer = search.solve(n + std::max(2, n / 2), intervals, best.unknowns, best.multiplier);
    error = bound = std::max(kLeastError, compare(hand.velocity, seriesOf(finer, curve.length(), duration).velocity));
  }
  while (unknowns == 0) {
    n += n / 2;
    if (n > kMostUnknowns) break;
    Optimum finer = search.solve(n, intervals, best.unknowns, best.multiplier);
    MotionSeries changed = seriesOf(finer, curve.length(), duration);
    const double change = compare(hand.velocity, changed.velocity);
    error = estimateError(change, before);
    bound = boundError(change, std::exchange(before, change));
    best = std::move(finer), hand = std::move(changed);
    if (error < kCurveProfile) break;
  }
  auto fine = std::make_unique<CurveMotion>(search.follow(best, kFinerIntervals * intervals));
  double miss = search.missOf(*fine) / curve.length();
  while (miss > kArrived && 2 * intervals <= kMaxIntervals) {
    intervals *= 2;
    best = search.solve(static_cast<int>(best.unknowns.size()), intervals, best.unknowns, best.multiplier);
    fine = std::make_unique<CurveMotion>(search.follow(best, kFinerIntervals * intervals));
    const double missed = std::exchange(miss, search.missOf(*fine) / curve.length());
    if (miss > 0.5 * missed) break;  // rounding, not the intervals
  }
  const double rounding = kEndRounding * curve.length();
  if (fine->lowest() < curve.lowest() - rounding || fine->highest() > curve.highest() + rounding)
    throw RefusedError(
        fmt::format("the object would leave the smooth part of the curve: it moves from {:.3g} to {:.3g} m of arc length, the curve "
                    "is smooth from {:.3g} to {:.3g} m; allow more time",
                    fine->lowest(), fine->highest(), curve.lowest(), curve.highest()));
  auto prediction = std::make_unique<CurveObjectPrediction>(seriesOf(best, curve.length(), duration), fine->makeProfile(), object.source,
                                                            duration, search.fastest());
  prediction->distance = curve.length();
  prediction->cost = best.cost;
  prediction->condition = best.condition;
  if (bound > 0) prediction->profileError = bound;
  if (error >= kCurveProfile)
    prediction->warnings.push_back(fmt::format("the profile is known to {:.0e} of its peak only: the way bends too sharply for {} unknowns",
                                               error, best.unknowns.size()));
  if (miss > 1e-8) prediction->warnings.push_back(fmt::format("the masses miss the target by {:.0e} of the way", miss));
  return prediction;
}

}  // namespace reachlab::predict
