#include "sim/predict/line/line_predictions.h"

#include <cmath>

#include "constraints/formula/sincos.h"
#include "sim/predict/line/min_norm.h"
#include "sim/predict/line/modes.h"

namespace reachlab::predict {
namespace {

constexpr int kOddPowers = 5;  // sigma, sigma^3 … sigma^9: the hand-crackle variant reaches the last

// Z(tau) = odd polynomial in sigma = tau/H + sum trig_j sin W_j tau, and its second derivative in the same form.
struct OddMotion {
  Eigen::Matrix<double, kOddPowers, 1> power = Eigen::Matrix<double, kOddPowers, 1>::Zero();
  Eigen::VectorXd sine;
};
struct RigidMotion {
  OddMotion position, acceleration;
};

double legendreCoefficient(int degree, int power) {  // of sigma^power in P_degree, degree <= 4
  static constexpr double kLegendre[5][5] = {
      {1, 0, 0, 0, 0}, {0, 1, 0, 0, 0}, {-0.5, 0, 1.5, 0, 0}, {0, -1.5, 0, 2.5, 0}, {0.375, 0, -3.75, 0, 4.375}};
  return kLegendre[degree][power];
}

// Integrates g r times; each even function on the way vanishes at the ends, which fixes its constant (odd ones need none).
RigidMotion integrateMotion(const MinNormMotion& motion, const Eigen::VectorXd& frequency) {
  const double H = motion.halfTime;
  std::array<double, 2 * kOddPowers> power{};
  const bool evenStart = motion.order % 2 == 1;
  for (Eigen::Index i = 0; i < motion.polynomial.size(); ++i) {
    const int degree = static_cast<int>(2 * i) + (evenStart ? 0 : 1);
    for (int p = 0; p <= degree; ++p) power[p] += motion.polynomial(i) * legendreCoefficient(degree, p);
  }
  Eigen::VectorXd trig = motion.trig;
  bool even = evenStart;
  const auto asOdd = [&] {
    OddMotion odd;
    for (int k = 0; k < kOddPowers; ++k) odd.power(k) = power[2 * k + 1];
    odd.sine = trig;
    return odd;
  };
  RigidMotion rigid;
  if (motion.order == 2) rigid.acceleration = asOdd();
  for (int step = 1; step <= motion.order; ++step) {
    for (int p = 2 * kOddPowers - 1; p > 0; --p) power[p] = H * power[p - 1] / p;
    power[0] = 0;
    trig = (even ? 1.0 : -1.0) * trig.cwiseQuotient(frequency);
    even = !even;
    if (even) {
      double end = 0;
      for (const double c : power) end += c;
      for (Eigen::Index j = 0; j < trig.size(); ++j) end += trig(j) * constraints::cosine(frequency(j) * H);
      power[0] = -end;
    }
    if (step == motion.order - 2) rigid.acceleration = asOdd();
  }
  rigid.position = asOdd();
  return rigid;
}

// Every position is L/2 + row of coefficients times [sigma^1, sigma^3, …, sin W_j tau, sigma cos W_j tau].
class SymmetricPrediction final : public Prediction {
 public:
  SymmetricPrediction(double halfTime, double half, Eigen::VectorXd frequency, Eigen::RowVectorXd hand, Eigen::MatrixXd masses,
                      std::vector<int> source)
      : halfTime_(halfTime), half_(half), frequency_(std::move(frequency)), hand_(std::move(hand)), masses_(std::move(masses)),
        source_(std::move(source)) {
    massCount_ = static_cast<int>(source_.size());
    fastest_ = frequency_.size() > 0 ? frequency_.maxCoeff() : 0;
  }

  PredictedHand handAt(double t) const override {
    PredictedHand out{half_, 0, 0};
    addColumns(t, [&](Eigen::Index column, double value, double rate, double rateOfRate) {
      out.position += hand_(column) * value;
      out.velocity += hand_(column) * rate;
      out.acceleration += hand_(column) * rateOfRate;
    });
    return out;
  }

  double objectVelocityAt(double t) const override { return velocitiesAt(t).object; }

  // Both are even about the middle, so that the first half tells the second.
  void sampleVelocities(std::span<double> hand, std::span<double> object) const override {
    const size_t last = hand.size() - 1;
    for (size_t i = 0; 2 * i <= last; ++i) {
      const Velocities v = velocitiesAt(2 * halfTime_ * static_cast<double>(i) / static_cast<double>(last));
      hand[i] = hand[last - i] = v.hand;
      object[i] = object[last - i] = v.object;
    }
  }

  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    for (int i = 0; i < massCount_; ++i) position[i] = half_, velocity[i] = 0;
    addColumns(t, [&](Eigen::Index column, double value, double rate, double) {
      for (int i = 0; i < massCount_; ++i) {
        position[i] += masses_(source_[i], column) * value;
        velocity[i] += masses_(source_[i], column) * rate;
      }
    });
  }

 private:
  // Gives each function of the coefficients' columns, with its first and second derivative by time, to `add`.
  template <class Add>
  void addColumns(double t, Add&& add) const {
    const double perHalf = 1 / halfTime_, s = (t - halfTime_) * perHalf, s2 = s * s;
    double odd = s, even = 1, before = 0;  // sigma^(2k+1), sigma^(2k), sigma^(2k-1)
    for (int k = 0; k < kOddPowers; ++k) {
      const double n = 2 * k + 1;
      add(k, odd, n * even * perHalf, n * (n - 1) * before * perHalf * perHalf);
      before = odd, odd *= s2, even *= s2;
    }
    const Eigen::Index n = frequency_.size();
    for (Eigen::Index j = 0; j < n; ++j) {
      double sine, cosine;
      const double w = frequency_(j);
      constraints::sinCos(w * (t - halfTime_), sine, cosine);
      add(kOddPowers + j, sine, w * cosine, -w * w * sine);
      add(kOddPowers + n + j, s * cosine, perHalf * cosine - s * w * sine, -w * (2 * perHalf * sine + s * w * cosine));
    }
  }

  struct Velocities {
    double hand = 0, object = 0;  // of the last mass
  };
  Velocities velocitiesAt(double t) const {
    const auto object = masses_.row(source_.back());
    Velocities v;
    addColumns(t, [&](Eigen::Index column, double, double rate, double) {
      v.hand += hand_(column) * rate;
      v.object += object(column) * rate;
    });
    return v;
  }

  double halfTime_, half_;
  Eigen::VectorXd frequency_;
  Eigen::RowVectorXd hand_;
  Eigen::MatrixXd masses_;
  std::vector<int> source_;
};

// Coefficients of the modal answer q_j to Z'' (docs/theory/criteria.md, "Masses in closed form"), in the basis above.
Eigen::MatrixXd computeModalResponse(const RigidMotion& rigid, const Modes& modes, double H) {
  const Eigen::Index n = modes.frequency.size();
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(n, kOddPowers + 2 * n);
  const Eigen::VectorXd& w = modes.frequency;
  Eigen::VectorXd sine(n), cosine(n);  // of W_j H
  for (Eigen::Index j = 0; j < n; ++j) constraints::sinCos(w(j) * H, sine(j), cosine(j));
  for (Eigen::Index j = 0; j < n; ++j) {
    const double drive = modes.drive(j), w2 = w(j) * w(j);
    for (int k = kOddPowers - 1; k >= 0; --k) {
      const double above = k + 1 < kOddPowers ? (2 * k + 3.0) * (2 * k + 2.0) * q(j, k + 1) / (H * H) : 0.0;
      q(j, k) = -(drive * rigid.acceleration.power(k) + above) / w2;
    }
    for (Eigen::Index i = 0; i < n; ++i)
      if (i != j) q(j, kOddPowers + i) = -drive * rigid.acceleration.sine(i) / ((w(j) - w(i)) * (w(j) + w(i)));
    const double resonance = drive * rigid.acceleration.sine(j) / (2 * w(j));  // of tau cos W_j tau
    q(j, kOddPowers + n + j) = resonance * H;

    // Both end conditions q = q' = 0 at H give the homogeneous part without dividing by a small sine.
    double end = resonance * H * cosine(j), endRate = resonance * (cosine(j) - w(j) * H * sine(j));
    for (int k = 0; k < kOddPowers; ++k) end += q(j, k), endRate += q(j, k) * (2 * k + 1) / H;
    for (Eigen::Index i = 0; i < n; ++i)
      if (i != j) {
        end += q(j, kOddPowers + i) * sine(i);
        endRate += q(j, kOddPowers + i) * w(i) * cosine(i);
      }
    q(j, kOddPowers + j) = -(end * sine(j) + endRate * cosine(j) / w(j));
  }
  return q;
}

Eigen::RowVectorXd asRow(const OddMotion& motion) {
  const Eigen::Index n = motion.sine.size();
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kOddPowers + 2 * n);
  row.head(kOddPowers) = motion.power.transpose();
  row.segment(kOddPowers, n) = motion.sine.transpose();
  return row;
}

bool isByHand(Criterion criterion) { return criterion == Criterion::MinHandJerk || criterion == Criterion::MinHandCrackle; }

int orderOf(Criterion criterion) {
  if (criterion == Criterion::MinHandCrackle) return 5;
  return criterion == Criterion::MinHandForce || criterion == Criterion::MinComAcceleration ? 2 : 3;
}

}  // namespace

std::unique_ptr<Prediction> makeRigidPrediction(double mass, Criterion criterion, double distance, double duration) {
  const bool byForce = criterion == Criterion::MinHandForce || criterion == Criterion::MinHandForceChange;
  const Eigen::VectorXd none;
  const MinNormMotion motion = solveMinNorm(orderOf(criterion), distance, duration / 2, none);
  const Eigen::RowVectorXd z = asRow(integrateMotion(motion, none).position);
  auto prediction = std::make_unique<SymmetricPrediction>(duration / 2, distance / 2, none, z, z, std::vector<int>{0});
  prediction->cost = (byForce ? mass * mass : 1.0) * motion.cost;
  prediction->condition = motion.condition;
  return prediction;
}

std::unique_ptr<Prediction> makeSymmetricPrediction(const LineObject& object, Criterion criterion, double distance, double duration) {
  const bool byHand = isByHand(criterion), byForceChange = criterion == Criterion::MinHandForceChange;
  const double mass = object.totalMass();
  const double gain = byHand || criterion == Criterion::MinComAcceleration ? 1.0 : mass;
  const double H = duration / 2;

  const Modes modes = byHand ? computeClampedModes(object) : computeFreeModes(object);
  const MinNormMotion motion = solveMinNorm(orderOf(criterion), distance, H, modes.frequency);
  const RigidMotion rigid = integrateMotion(motion, modes.frequency);
  const Eigen::RowVectorXd z = asRow(rigid.position), force = mass * asRow(rigid.acceleration);
  Eigen::MatrixXd nodes = modes.shape * computeModalResponse(rigid, modes, H);
  nodes.rowwise() += z;

  Eigen::RowVectorXd hand = z;
  bool algebraicHand = false;
  if (!byHand && object.handMass > 0) {
    hand = nodes.row(0);
    nodes = nodes.bottomRows(object.count()).eval();
  } else if (!byHand) {  // f = k (h - x1), or f = sum k_i (h - x_i)
    algebraicHand = true;
    double stiffness = object.springs[0];
    hand = force + object.springs[0] * nodes.row(0);
    for (int i = 1; object.parallel && i < object.count(); ++i) {
      hand += object.springs[i] * nodes.row(i);
      stiffness += object.springs[i];
    }
    hand /= stiffness;
  }

  auto prediction = std::make_unique<SymmetricPrediction>(H, distance / 2, modes.frequency, hand, nodes, object.source);
  prediction->cost = gain * gain * motion.cost;
  prediction->condition = motion.condition;
  if (algebraicHand) {  // the force may jump (4, 6) or its rate (5): so does the hand or its velocity
    const PredictedHand start = prediction->handAt(0);
    if (byForceChange) prediction->handVelocityJump = start.velocity;
    else prediction->handJump = start.position, prediction->handVelocityJump.reset();
  }
  return prediction;
}

}  // namespace reachlab::predict
