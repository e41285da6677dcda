#include "sim/predict/curve/curve_motion.h"

#include <algorithm>
#include <cmath>

#include "base/math/gauss_legendre.h"
#include "sim/predict/transcription/rest_to_rest_basis.h"

namespace reachlab::predict {
namespace {

constexpr int kStages = CurveMotion::kStages;

// Gauss's collocation on [0, 1]: after Hairer, Lubich and Wanner, Geometric Numerical Integration, II.1.
struct Collocation {
  std::array<double, kStages> node{}, weight{};
  std::array<double, kStages> twice{};                        // of the accelerations in the position at the end
  Eigen::Matrix<double, kStages, kStages> once, twiceInside;  // integrals from 0 to every node, and of those
};

const Collocation& collocation() {
  static const Collocation made = [] {
    Collocation c;
    const GaussRule rule = makeGaussRule(kStages);
    for (int l = 0; l < kStages; ++l) {
      c.node[l] = (rule.node[l] + 1) / 2;
      c.weight[l] = rule.weight[l] / 2;
      std::vector<double> one(kStages, 0.0);
      one[l] = 1;
      const LegendreSeries integral = integralOf(projectOnLegendre(one, rule.node, rule.weight));
      for (int k = 0; k < kStages; ++k) c.once(k, l) = valueAt(integral, rule.node[k]) / 2;
    }
    c.twiceInside = c.once * c.once;
    for (int l = 0; l < kStages; ++l)
      for (int k = 0; k < kStages; ++k) c.twice[l] += c.weight[k] * c.once(k, l);
    return c;
  }();
  return made;
}

}  // namespace

CurveMotion::CurveMotion(const constraints::ArcCurve& curve, const LineObject& object, double duration, int intervals)
    : curve_(curve), object_(object), intervals_(intervals), n_(object.count()), width_(duration / intervals),
      interval_(static_cast<size_t>(intervals)) {
  for (Interval& interval : interval_) {
    interval.position = interval.speed = Vector::Zero(n_);
    interval.acceleration = Vector::Zero(n_ * kStages);
    interval.jacobian.resize(kStages);
  }
}

double CurveMotion::timeOf(int node) const { return width_ * (node / kStages + collocation().node[node % kStages]); }

// Arc lengths and speeds of hand and masses at one stage, from the accelerations.
void CurveMotion::locateStage(const Interval& interval, int first, int stage, Vector& s, Vector& v) const {
  const Collocation& c = collocation();
  s(0) = handPosition_(first + stage);
  v(0) = handSpeed_(first + stage);
  s.tail(n_) = interval.position + width_ * c.node[stage] * interval.speed;
  v.tail(n_) = interval.speed;
  for (int l = 0; l < kStages; ++l) {
    s.tail(n_) += width_ * width_ * c.twiceInside(stage, l) * interval.acceleration.segment(l * n_, n_);
    v.tail(n_) += width_ * c.once(stage, l) * interval.acceleration.segment(l * n_, n_);
  }
}

CurveMotion::Matrix CurveMotion::stageSystem(const Interval& interval) const {
  const Collocation& c = collocation();
  const int nodes = n_ + 1;
  Matrix system = Matrix::Identity(n_ * kStages, n_ * kStages);
  for (int k = 0; k < kStages; ++k) {
    const Matrix& jacobian = interval.jacobian[k];
    for (int l = 0; l < kStages; ++l)
      system.block(k * n_, l * n_, n_, n_) -=
          width_ * width_ * c.twiceInside(k, l) * jacobian.middleCols(1, n_) + width_ * c.once(k, l) * jacobian.middleCols(nodes + 1, n_);
  }
  return system;
}

bool CurveMotion::solveInterval(Interval& interval, int first) {
  constexpr int kPasses = 20;
  constexpr double kSettled = 1e-9;  // relative; the error after the step is its square
  Vector s(n_ + 1), v(n_ + 1), rest(n_ * kStages), a(n_);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int k = 0; k < kStages; ++k) {
      locateStage(interval, first, k, s, v);
      expandAccelerations(curve_, object_, s.data(), v.data(), a.data(), &interval.jacobian[k]);
      rest.segment(k * n_, n_) = a - interval.acceleration.segment(k * n_, n_);
    }
    interval.factor.compute(stageSystem(interval));
    const Vector step = interval.factor.solve(rest);
    interval.acceleration += step;
    if (!interval.acceleration.allFinite()) return false;
    if (step.norm() <= kSettled * interval.acceleration.norm() + 1e-14) return true;
  }
  return false;
}

bool CurveMotion::follow(const Vector& handPosition, const Vector& handSpeed) {
  const Collocation& c = collocation();
  handPosition_ = handPosition;
  handSpeed_ = handSpeed;
  Vector position = Vector::Zero(n_), speed = Vector::Zero(n_), s(n_ + 1), v(n_ + 1);
  lowest_ = highest_ = 0;
  for (int p = 0; p < intervals_; ++p) {
    Interval& interval = interval_[p];
    interval.position = position;
    interval.speed = speed;
    if (!solveInterval(interval, p * kStages)) return false;
    position += width_ * speed;
    for (int l = 0; l < kStages; ++l) {
      const auto a = interval.acceleration.segment(l * n_, n_);
      position += width_ * width_ * c.twice[l] * a;
      speed += width_ * c.weight[l] * a;
    }
    lowest_ = std::min(lowest_, position.minCoeff());
    highest_ = std::max(highest_, position.maxCoeff());
  }
  end_.resize(2 * n_);
  end_ << position, speed;
  return end_.allFinite();
}

CurveMotion::Matrix CurveMotion::linearise(const Matrix& handPosition, const Matrix& handSpeed) {
  const Collocation& c = collocation();
  const int nodes = n_ + 1, columns = static_cast<int>(handPosition.cols());
  Matrix position = Matrix::Zero(n_, columns), speed = position, source(n_ * kStages, columns);
  local_.resize(2 * nodes * this->nodes(), columns);
  for (int p = 0; p < intervals_; ++p) {
    const Interval& interval = interval_[p];
    const int first = p * kStages;
    for (int k = 0; k < kStages; ++k) {
      const Matrix& jacobian = interval.jacobian[k];
      auto rows = source.middleRows(k * n_, n_);
      rows.noalias() = jacobian.middleCols(1, n_) * (position + width_ * c.node[k] * speed);
      rows.noalias() += jacobian.middleCols(nodes + 1, n_) * speed;
      rows.noalias() += jacobian.col(0) * handPosition.row(first + k);
      rows.noalias() += jacobian.col(nodes) * handSpeed.row(first + k);
    }
    const Matrix a = interval.factor.solve(source);
    for (int k = 0; k < kStages; ++k) {
      auto s = local_.middleRows(2 * nodes * (first + k), nodes), v = local_.middleRows(2 * nodes * (first + k) + nodes, nodes);
      s.row(0) = handPosition.row(first + k);
      v.row(0) = handSpeed.row(first + k);
      s.bottomRows(n_) = position + width_ * c.node[k] * speed;
      v.bottomRows(n_) = speed;
      for (int l = 0; l < kStages; ++l) {
        s.bottomRows(n_) += width_ * width_ * c.twiceInside(k, l) * a.middleRows(l * n_, n_);
        v.bottomRows(n_) += width_ * c.once(k, l) * a.middleRows(l * n_, n_);
      }
    }
    position += width_ * speed;
    for (int l = 0; l < kStages; ++l) {
      position += width_ * width_ * c.twice[l] * a.middleRows(l * n_, n_);
      speed += width_ * c.weight[l] * a.middleRows(l * n_, n_);
    }
  }
  Matrix end(2 * n_, columns);
  end << position, speed;
  return end;
}

// A change of the accelerations by a source of second order reaches the end through the transposed stage systems (the adjoint of
// the method itself): each stage's second derivatives enter with that weight.
CurveMotion::Matrix CurveMotion::computeHessian(const Vector& multiplier) const {
  const Collocation& c = collocation();
  const int nodes = n_ + 1;
  Vector onPosition = multiplier.head(n_), onSpeed = multiplier.tail(n_), drive(n_ * kStages), s(nodes), v(nodes), a(n_);
  Matrix bent(local_.rows(), local_.cols()), hessian(2 * nodes, 2 * nodes);
  for (int p = intervals_; p-- > 0;) {
    const Interval& interval = interval_[p];
    const int first = p * kStages;
    for (int l = 0; l < kStages; ++l)
      drive.segment(l * n_, n_) = width_ * width_ * c.twice[l] * onPosition + width_ * c.weight[l] * onSpeed;
    const Vector weight = interval.factor.transpose().solve(drive);
    onSpeed += width_ * onPosition;
    for (int k = 0; k < kStages; ++k) {
      const Matrix& jacobian = interval.jacobian[k];
      const auto w = weight.segment(k * n_, n_);
      const Vector back = jacobian.middleCols(1, n_).transpose() * w;
      onPosition += back;
      onSpeed += width_ * c.node[k] * back + jacobian.middleCols(nodes + 1, n_).transpose() * w;
      locateStage(interval, first, k, s, v);
      hessian.setZero();
      expandAccelerations(curve_, object_, s.data(), v.data(), a.data(), nullptr, &weight[k * n_], &hessian);
      bent.middleRows(2 * nodes * (first + k), 2 * nodes).noalias() = hessian * local_.middleRows(2 * nodes * (first + k), 2 * nodes);
    }
  }
  Matrix result(local_.cols(), local_.cols());
  result.triangularView<Eigen::Lower>() = local_.transpose() * bent;
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

PiecewiseSeries CurveMotion::makeProfile() const {
  const Collocation& c = collocation();
  // Powers of s = (x + 1)/2 of the polynomial through one stage: by Newton's divided differences of the Lagrange product.
  std::array<std::array<double, kStages>, kStages> power{};
  for (size_t l = 0; l < kStages; ++l) {
    std::array<double, kStages + 1> product{1};
    size_t degree = 0;
    for (size_t k = 0; k < kStages; ++k) {
      if (k == l) continue;
      ++degree;
      for (size_t j = degree + 1; j-- > 0;)
        product[j] = ((j > 0 ? product[j - 1] : 0) - (j < degree ? c.node[k] * product[j] : 0)) / (c.node[l] - c.node[k]);
    }
    for (size_t j = 0; j < kStages; ++j) power[l][j] = product[j];
  }
  PiecewiseSeries profile(n_, kStages + 2, intervals_);
  profile.width = width_;
  for (int p = 0; p < intervals_; ++p) {
    const Interval& interval = interval_[p];
    for (int i = 0; i < n_; ++i) {
      std::array<double, kStages + 2> series{interval.position(i), width_ * interval.speed(i)};
      for (size_t j = 0; j < kStages; ++j) {
        double sum = 0;
        for (int l = 0; l < kStages; ++l) sum += power[l][j] * interval.acceleration(l * n_ + i);
        series[j + 2] = width_ * width_ * sum / static_cast<double>((j + 1) * (j + 2));
      }
      for (size_t k = 0; k < series.size(); ++k) profile.of(p, i)[k][p % kBatchLanes] = series[k];
    }
  }
  return profile;
}

}  // namespace reachlab::predict
