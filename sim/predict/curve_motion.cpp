#include "sim/predict/curve_motion.h"

#include <algorithm>
#include <cmath>

#include "sim/predict/gauss_legendre.h"
#include "sim/predict/legendre.h"

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
    const GaussRule<double> rule = makeGaussRule<double>(kStages);
    for (int l = 0; l < kStages; ++l) {
      const auto i = static_cast<size_t>(l);
      c.node[i] = (rule.node[i] + 1) / 2;
      c.weight[i] = rule.weight[i] / 2;
      std::vector<double> one(kStages, 0.0);
      one[i] = 1;
      const LegendreSeries integral = integrate(projectOnLegendre(one, rule.node, rule.weight));
      for (int k = 0; k < kStages; ++k) c.once(k, l) = evaluate(integral, rule.node[static_cast<size_t>(k)]) / 2;
    }
    c.twiceInside = c.once * c.once;
    for (int l = 0; l < kStages; ++l)
      for (int k = 0; k < kStages; ++k) c.twice[static_cast<size_t>(l)] += c.weight[static_cast<size_t>(k)] * c.once(k, l);
    return c;
  }();
  return made;
}

}  // namespace

CurveMotion::CurveMotion(const ArcCurve& curve, const CurveObject& object, double duration, int panels)
    : curve_(curve), object_(object), panels_(panels), n_(object.count()), width_(duration / panels), panel_(static_cast<size_t>(panels)) {
  for (Panel& panel : panel_) {
    panel.position = panel.speed = Vector::Zero(n_);
    panel.acceleration = Vector::Zero(n_ * kStages);
    panel.slope.resize(kStages);
  }
}

double CurveMotion::timeOf(int node) const { return width_ * (node / kStages + collocation().node[static_cast<size_t>(node % kStages)]); }

// Arc lengths and speeds of hand and masses at one stage, from the accelerations.
void CurveMotion::locateStage(const Panel& panel, int first, int stage, Vector& s, Vector& v) const {
  const Collocation& c = collocation();
  s(0) = handPosition_(first + stage);
  v(0) = handSpeed_(first + stage);
  s.tail(n_) = panel.position + width_ * c.node[static_cast<size_t>(stage)] * panel.speed;
  v.tail(n_) = panel.speed;
  for (int l = 0; l < kStages; ++l) {
    s.tail(n_) += width_ * width_ * c.twiceInside(stage, l) * panel.acceleration.segment(l * n_, n_);
    v.tail(n_) += width_ * c.once(stage, l) * panel.acceleration.segment(l * n_, n_);
  }
}

CurveMotion::Matrix CurveMotion::stageSystem(const Panel& panel) const {
  const Collocation& c = collocation();
  const int nodes = n_ + 1;
  Matrix system = Matrix::Identity(n_ * kStages, n_ * kStages);
  for (int k = 0; k < kStages; ++k) {
    const Matrix& slope = panel.slope[static_cast<size_t>(k)];
    for (int l = 0; l < kStages; ++l)
      system.block(k * n_, l * n_, n_, n_) -=
          width_ * width_ * c.twiceInside(k, l) * slope.middleCols(1, n_) + width_ * c.once(k, l) * slope.middleCols(nodes + 1, n_);
  }
  return system;
}

bool CurveMotion::solvePanel(Panel& panel, int first) {
  constexpr int kPasses = 20;
  constexpr double kSettled = 1e-9;  // relative; the error after the step is its square
  Vector s(n_ + 1), v(n_ + 1), rest(n_ * kStages), a(n_);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int k = 0; k < kStages; ++k) {
      locateStage(panel, first, k, s, v);
      expandAccelerations(curve_, object_, s.data(), v.data(), a.data(), &panel.slope[static_cast<size_t>(k)]);
      rest.segment(k * n_, n_) = a - panel.acceleration.segment(k * n_, n_);
    }
    panel.factor.compute(stageSystem(panel));
    const Vector step = panel.factor.solve(rest);
    panel.acceleration += step;
    if (!panel.acceleration.allFinite()) return false;
    if (step.norm() <= kSettled * panel.acceleration.norm() + 1e-14) return true;
  }
  return false;
}

bool CurveMotion::follow(const Vector& handPosition, const Vector& handSpeed) {
  const Collocation& c = collocation();
  handPosition_ = handPosition;
  handSpeed_ = handSpeed;
  Vector position = Vector::Zero(n_), speed = Vector::Zero(n_), s(n_ + 1), v(n_ + 1);
  lowest_ = highest_ = 0;
  for (int p = 0; p < panels_; ++p) {
    Panel& panel = panel_[static_cast<size_t>(p)];
    panel.position = position;
    panel.speed = speed;
    if (!solvePanel(panel, p * kStages)) return false;
    position += width_ * speed;
    for (int l = 0; l < kStages; ++l) {
      const auto a = panel.acceleration.segment(l * n_, n_);
      position += width_ * width_ * c.twice[static_cast<size_t>(l)] * a;
      speed += width_ * c.weight[static_cast<size_t>(l)] * a;
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
  for (int p = 0; p < panels_; ++p) {
    const Panel& panel = panel_[static_cast<size_t>(p)];
    const int first = p * kStages;
    for (int k = 0; k < kStages; ++k) {
      const Matrix& slope = panel.slope[static_cast<size_t>(k)];
      auto rows = source.middleRows(k * n_, n_);
      rows.noalias() = slope.middleCols(1, n_) * (position + width_ * c.node[static_cast<size_t>(k)] * speed);
      rows.noalias() += slope.middleCols(nodes + 1, n_) * speed;
      rows.noalias() += slope.col(0) * handPosition.row(first + k);
      rows.noalias() += slope.col(nodes) * handSpeed.row(first + k);
    }
    const Matrix a = panel.factor.solve(source);
    for (int k = 0; k < kStages; ++k) {
      auto s = local_.middleRows(2 * nodes * (first + k), nodes), v = local_.middleRows(2 * nodes * (first + k) + nodes, nodes);
      s.row(0) = handPosition.row(first + k);
      v.row(0) = handSpeed.row(first + k);
      s.bottomRows(n_) = position + width_ * c.node[static_cast<size_t>(k)] * speed;
      v.bottomRows(n_) = speed;
      for (int l = 0; l < kStages; ++l) {
        s.bottomRows(n_) += width_ * width_ * c.twiceInside(k, l) * a.middleRows(l * n_, n_);
        v.bottomRows(n_) += width_ * c.once(k, l) * a.middleRows(l * n_, n_);
      }
    }
    position += width_ * speed;
    for (int l = 0; l < kStages; ++l) {
      position += width_ * width_ * c.twice[static_cast<size_t>(l)] * a.middleRows(l * n_, n_);
      speed += width_ * c.weight[static_cast<size_t>(l)] * a.middleRows(l * n_, n_);
    }
  }
  Matrix end(2 * n_, columns);
  end << position, speed;
  return end;
}

// A change of the accelerations by a source of second order reaches the end through the transposed stage systems (the adjoint of
// the method itself): each stage's second derivatives enter with that weight.
CurveMotion::Matrix CurveMotion::computeBend(const Vector& multiplier) const {
  const Collocation& c = collocation();
  const int nodes = n_ + 1;
  Vector onPosition = multiplier.head(n_), onSpeed = multiplier.tail(n_), drive(n_ * kStages), s(nodes), v(nodes), a(n_);
  Matrix bent(local_.rows(), local_.cols()), bend(2 * nodes, 2 * nodes);
  for (int p = panels_; p-- > 0;) {
    const Panel& panel = panel_[static_cast<size_t>(p)];
    const int first = p * kStages;
    for (int l = 0; l < kStages; ++l)
      drive.segment(l * n_, n_) =
          width_ * width_ * c.twice[static_cast<size_t>(l)] * onPosition + width_ * c.weight[static_cast<size_t>(l)] * onSpeed;
    const Vector weight = panel.factor.transpose().solve(drive);
    onSpeed += width_ * onPosition;
    for (int k = 0; k < kStages; ++k) {
      const Matrix& slope = panel.slope[static_cast<size_t>(k)];
      const auto w = weight.segment(k * n_, n_);
      const Vector back = slope.middleCols(1, n_).transpose() * w;
      onPosition += back;
      onSpeed += width_ * c.node[static_cast<size_t>(k)] * back + slope.middleCols(nodes + 1, n_).transpose() * w;
      locateStage(panel, first, k, s, v);
      bend.setZero();
      expandAccelerations(curve_, object_, s.data(), v.data(), a.data(), nullptr, &weight[k * n_], &bend);
      bent.middleRows(2 * nodes * (first + k), 2 * nodes).noalias() = bend * local_.middleRows(2 * nodes * (first + k), 2 * nodes);
    }
  }
  Matrix result(local_.cols(), local_.cols());
  result.triangularView<Eigen::Lower>() = local_.transpose() * bent;
  result.triangularView<Eigen::StrictlyUpper>() = result.transpose();
  return result;
}

SeriesProfile CurveMotion::makeProfile() const {
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
  SeriesProfile profile;
  profile.outputs = n_;
  profile.terms = kStages + 2;
  profile.panels = panels_;
  profile.width = width_;
  for (const Panel& panel : panel_)
    for (int i = 0; i < n_; ++i) {
      std::array<double, kStages + 2> series{panel.position(i), width_ * panel.speed(i)};
      for (size_t j = 0; j < kStages; ++j) {
        double sum = 0;
        for (int l = 0; l < kStages; ++l) sum += power[static_cast<size_t>(l)][j] * panel.acceleration(l * n_ + i);
        series[j + 2] = width_ * width_ * sum / static_cast<double>((j + 1) * (j + 2));
      }
      profile.coefficient.insert(profile.coefficient.end(), series.begin(), series.end());
    }
  return profile;
}

}  // namespace reachlab::predict
