#include "sim/analyze/predicted_profile.h"

#include <algorithm>
#include <cmath>

namespace reachlab {

PredictedProfile sampleProfile(const Prediction& prediction, const OnsetOptions& options, double taskOnset) {
  constexpr double kRate = 2000;  // [Hz] fine enough that its own interpolation does not show (1e-6 of the peak)
  const double T = prediction.duration;
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil(T * kRate)));
  const double rate = static_cast<double>(steps) / T;

  // One sample of rest on either side, so that a velocity that jumps at an end is crossed there.
  std::vector<double> speed(steps + 3, 0.0);
  double movedAt = 0;
  bool moved = false;
  for (std::size_t i = 0; i <= steps; ++i) {
    const PredictedHand hand = prediction.handAt(static_cast<double>(i) / rate);
    speed[i + 1] = std::abs(hand.velocity);
    moved = moved || std::abs(hand.position) > taskOnset;
    if (!moved) movedAt = static_cast<double>(i) / rate;
  }
  double first = movedAt, last = T;
  if (options.rule != OnsetRule::Task) {
    const Movement movement = findMovement(speed, rate, options);
    first = std::clamp(movement.onset - 1 / rate, 0.0, T);
    last = std::clamp(movement.offset - 1 / rate, 0.0, T);
  }

  PredictedProfile profile;
  profile.criterion = prediction.criterion;
  profile.taskDuration = T;
  profile.duration = last - first;
  profile.warnings = prediction.warnings;
  std::vector<double> position(static_cast<std::size_t>(prediction.massCount())), velocity(position.size());
  for (std::size_t i = 0; i < kProfilePoints; ++i) {
    const double t = first + (last - first) * static_cast<double>(i) / static_cast<double>(kProfilePoints - 1);
    profile.hand.push_back(prediction.handAt(t).velocity);
    prediction.massesAt(t, position, velocity);
    profile.object.push_back(velocity.empty() ? 0 : velocity.back());
  }
  return profile;
}

PredictedProfile scaledTo(PredictedProfile profile, double duration) {
  const double factor = profile.duration / duration;
  for (double& v : profile.hand) v *= factor;
  for (double& v : profile.object) v *= factor;
  return profile;
}

}  // namespace reachlab
