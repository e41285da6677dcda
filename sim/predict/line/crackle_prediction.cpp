#include "sim/predict/line/line_predictions.h"

#include <algorithm>
#include <cmath>

#include "sim/predict/line/flat_output.h"

namespace reachlab::predict {
namespace {

using LongReal = long double;  // the sums of derivatives cancel by a few digits

class CracklePrediction final : public Prediction {
 public:
  CracklePrediction(const LineObject& object, double distanceInMetres, double seconds)
      : half_(seconds / 2), distance_(distanceInMetres), power_(2 * object.count() + 2), source_(object.source),
        node_(computeFlatPolynomials(object)) {
    massCount_ = static_cast<int>(source_.size());
    fastest_ = 2.0 * power_ / seconds;  // z and its derivatives have no more zeros than their degree
    // Times H^-k, so that rows multiply derivatives with respect to sigma.
    for (FlatPolynomial& p : node_)
      for (LongReal scale = 1; LongReal & c : p) c /= scale, scale *= half_;
    LongReal scale = 0.5L;  // (2n+1)! / (n!^2 2^(2n+1))
    for (int i = 1; i <= power_; ++i) scale *= (2 * i + 1) / (2.0L * i);
    slope_ = scale * distance_;
    // z^(n+1) = slope 2^n n! P_n(sigma) / H^(n+1) up to sign.
    LongReal top = slope_ / half_;
    for (int i = 1; i <= power_; ++i) top *= 2 * i / static_cast<LongReal>(half_);
    cost = static_cast<double>(top * top * half_ * 2 / (2 * power_ + 1));
    condition = computeAmplification();
  }

  PredictedHand handAt(double t) const override {
    std::vector<LongReal> z(derivatives());
    computeDerivatives(t, z, Wanted::All);
    const LongReal H = half_;
    return {static_cast<double>(sum(node_[0], z, 0)), static_cast<double>(sum(node_[0], z, 1) / H),
            static_cast<double>(sum(node_[0], z, 2) / (H * H))};
  }

  double objectVelocityAt(double t) const override {
    std::vector<LongReal> z(derivatives());
    computeDerivatives(t, z);
    return static_cast<double>(sum(node_[source_.back() + 1], z, 1) / half_);
  }

  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    std::vector<LongReal> z(derivatives());
    computeDerivatives(t, z, Wanted::All);
    for (int i = 0; i < massCount_; ++i) {
      position[i] = static_cast<double>(sum(node_[source_[i] + 1], z, 0));
      velocity[i] = static_cast<double>(sum(node_[source_[i] + 1], z, 1) / half_);
    }
  }

 private:
  size_t derivatives() const { return static_cast<size_t>(power_) + 1; }

  static LongReal sum(const FlatPolynomial& row, const std::vector<LongReal>& z, size_t shift) {
    LongReal s = 0;
    for (size_t k = 0; k < row.size(); ++k) s += row[k] * z[k + shift];
    return s;
  }

  enum class Wanted { Derivatives, All };
  // z (unless only its derivatives are asked for) and its derivatives with respect to sigma, up to order 2N+2. With F_m = f^(m) / (1 - sigma^2)^(n-m), f = (1 - sigma^2)^n:
  // F_(m+1) = 2 (m-n) sigma F_m + m (m-1-2n) (1 - sigma^2) F_(m-1), from (1 - sigma^2) f' = -2 n sigma f.
  void computeDerivatives(double t, std::vector<LongReal>& z, Wanted wanted = Wanted::Derivatives) const {
    const int n = power_;
    const LongReal s = std::clamp((static_cast<LongReal>(t) - half_) / half_, -1.0L, 1.0L), rest = (1 - s) * (1 + s);
    LongReal before = 0, now = 1;
    for (int m = 0; m < n; ++m) {
      z[m + 1] = slope_ * now;
      const LongReal next = 2 * (m - n) * s * now + m * (m - 1.0L - 2 * n) * rest * before;
      before = now, now = next;
    }
    LongReal power = rest;
    for (int m = n - 1; m > 0; --m, power *= rest) z[m + 1] *= power;
    z[1] *= power;
    if (wanted == Wanted::Derivatives) return;
    const LongReal low = (1 - std::abs(s)) / 2, ratio = low / (1 - low);  // I_low(n+1, n+1): a binomial tail, all terms positive
    LongReal tail = 0, term = 2 * slope_ / (distance_ * (n + 1)) * power * low;
    for (int j = n + 1; j <= 2 * n + 1; ++j) {
      tail += term;
      term *= ratio * (2 * n + 1 - j) / (j + 1);
    }
    z[0] = distance_ * (s < 0 ? tail : 1 - tail);
  }

  double computeAmplification() const {
    constexpr int kPoints = 100;
    std::vector<LongReal> z(derivatives());
    LongReal terms = 0, total = 0;
    for (int i = 0; i <= kPoints; ++i) {
      computeDerivatives(2 * half_ * i / kPoints, z);
      LongReal absolute = 0;
      for (size_t k = 0; k < node_[0].size(); ++k) absolute += std::abs(node_[0][k] * z[k + 1]);
      terms = std::max(terms, absolute);
      total = std::max(total, std::abs(sum(node_[0], z, 1)));
    }
    return static_cast<double>(terms / total);
  }

  double half_, distance_;
  int power_;  // n = 2N+2
  std::vector<int> source_;
  std::vector<FlatPolynomial> node_;
  LongReal slope_ = 0;  // of dz/dsigma at T/2
};

}  // namespace

std::unique_ptr<Prediction> makeCracklePrediction(const LineObject& object, double distance, double duration) {
  return std::make_unique<CracklePrediction>(object, distance, duration);
}

}  // namespace reachlab::predict
