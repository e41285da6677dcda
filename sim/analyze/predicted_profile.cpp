#include "sim/analyze/predicted_profile.h"

#include <algorithm>
#include <cmath>

#include "sim/analyze/filter.h"

namespace reachlab {

PredictedProfile sampleProfile(const Prediction& prediction, const MeasureOptions& options, double taskOnset) {
  constexpr double kRate = 1000;      // [Hz] fine enough that its own interpolation does not show (1e-6 of the peak)
  constexpr std::size_t kRest = 300;  // samples of rest on either side, in which the filter dies out
  const double T = prediction.duration;
  const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil(T * kRate)));
  const double rate = static_cast<double>(steps) / T, rest = static_cast<double>(kRest) / rate;

  std::vector<double> hand(steps + 1 + 2 * kRest, 0.0), object = hand;
  std::vector<double> position(static_cast<std::size_t>(prediction.massCount())), velocity(position.size());
  double movedAt = T;
  for (std::size_t i = steps + 1; i-- > 0;) {
    const double t = std::min(T, static_cast<double>(i) / rate);
    const PredictedHand at = prediction.handAt(t);
    prediction.massesAt(t, position, velocity);
    hand[i + kRest] = at.velocity;
    object[i + kRest] = velocity.empty() ? 0 : velocity.back();
    if (std::abs(at.position) > taskOnset) movedAt = t;
  }
  hand = lowPass(hand, rate, options.cutoff);
  std::vector<double> speed(hand.size());
  for (std::size_t i = 0; i < hand.size(); ++i) speed[i] = std::abs(hand[i]);
  const Movement movement = options.onset.rule == OnsetRule::Task ? movementWithin(speed, rate, rest + movedAt, rest + T)
                                                                  : findMovement(speed, rate, options.onset);
  PredictedProfile profile;
  profile.criterion = prediction.criterion;
  profile.taskDuration = T;
  profile.duration = movement.duration();
  profile.warnings = prediction.warnings;
  profile.hand = normaliseTime(hand, rate, movement.onset, movement.offset);
  profile.object = normaliseTime(object, rate, movement.onset, movement.offset);
  return profile;
}

PredictedProfile scaledTo(PredictedProfile profile, double duration) {
  const double factor = profile.duration / duration;
  for (double& v : profile.hand) v *= factor;
  for (double& v : profile.object) v *= factor;
  return profile;
}

}  // namespace reachlab
