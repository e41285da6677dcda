#include "sim/predict/prediction/prediction.h"

namespace reachlab::predict {

std::string_view nameOf(PointIs point) { return point == PointIs::Hand ? "hand" : "behind-spring"; }

double Prediction::objectVelocityAt(double t) const {
  if (massCount_ == 0) return handAt(t).velocity;  // the hand alone
  std::vector<double> x(massCount_), v(massCount_);
  massesAt(t, x, v);
  return v.back();
}

void Prediction::sampleVelocities(std::span<double> hand, std::span<double> object) const {
  const auto last = static_cast<double>(hand.size() - 1);
  for (size_t i = 0; i < hand.size(); ++i) {
    const double t = duration * static_cast<double>(i) / last;
    hand[i] = handAt(t).velocity;
    object[i] = objectVelocityAt(t);
  }
}

}  // namespace reachlab::predict
