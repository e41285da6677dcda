#include "analysis/measures/measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/measures/deviation_and_adaptation.h"
#include "analysis/measures/filter.h"
#include "analysis/measures/smoothness.h"

namespace reachlab::analysis {
namespace {

constexpr Measure kMeasures[] = {
    {"reaction_time_s", "From the go signal to onset_s; empty where the hand left before it", &TrialMeasures::reactionTime,
     "reaction time (s)"},
    {"onset_s", "Movement onset by the rule for onset, since arming", &TrialMeasures::onset, "onset since arming (s)"},
    {"offset_s", "Movement offset by the same rule, since arming", &TrialMeasures::offset, "offset since arming (s)"},
    {"duration_s", "From onset to offset", &TrialMeasures::duration, "duration, onset to offset (s)"},
    {"movement_time_s", "The task's own: from its onset to the end, or to where the trial was broken off", &TrialMeasures::movementTime,
     "movement time of the task (s)"},
    {"peak_speed_m_per_s", "Largest speed of the hand, of the filtered samples", &TrialMeasures::peakSpeed, "peak speed (m/s)"},
    {"time_to_peak_s", "From onset to the largest speed", &TrialMeasures::timeToPeak, "time to peak (s)"},
    {"time_to_peak_percent", "The same as a share of duration_s", &TrialMeasures::timeToPeakPercent, "time to peak (%)", 1, 1},
    {"symmetry_ratio", "Time to the peak over time from the peak to offset", &TrialMeasures::symmetryRatio, "symmetry ratio", 1, 2},
    {"path_length_m", "Length of the hand's path from onset to offset", &TrialMeasures::pathLength, "path length (mm)", 1e3, 1},
    {"speed_peaks", "Number of local maxima of the speed with a prominence of 5 % of the peak or more", &TrialMeasures::speedPeaks,
     "speed peaks", 1, 2},
    {"hand_endpoint_error_m", "Hand's displacement at offset against target minus start", &TrialMeasures::handEndpointError,
     "end-point error, hand (mm)", 1e3, 1},
    {"object_endpoint_error_m", "Distance of the last mass from the target at the trial's end", &TrialMeasures::objectEndpointError,
     "end-point error, object (mm)", 1e3, 1},
    {"hand_overshoot_m", "Farthest that the hand went beyond the target along the line, 0 or more; empty on bent constraints",
     &TrialMeasures::handOvershoot, "overshoot, hand (mm)", 1e3, 1},
    {"object_overshoot_m", "Farthest that the last mass went beyond the target along the line, 0 or more; empty on bent constraints",
     &TrialMeasures::objectOvershoot, "overshoot, object (mm)", 1e3, 1},
    {"sparc", "Spectral arc length of the speed, without unit (Balasubramanian et al. 2015)", &TrialMeasures::sparc, "SPARC"},
    {"ldlj", "Log dimensionless jerk, without unit (Balasubramanian et al. 2015)", &TrialMeasures::ldlj, "log dimensionless jerk", 1, 2},
    {"peak_force_n", "Largest coupling force over every tick of the movement; without logs, over its samples", &TrialMeasures::peakForce,
     "peak force (N)", 1, 2},
    {"mean_force_n", "Mean coupling force over every tick of the movement; without logs, over its samples", &TrialMeasures::meanForce,
     "mean force (N)", 1, 2},
    {"max_perpendicular_m",
     "Largest distance of the hand from the straight line to the target, positive to the right of the way; recorded samples, unfiltered",
     &TrialMeasures::maxPerpendicular, "largest deviation (mm)", 1e3, 1},
    {"perpendicular_at_peak_speed_m", "The same at the largest recorded speed", &TrialMeasures::perpendicularAtPeakSpeed,
     "deviation at peak speed (mm)", 1e3, 1},
    {"hand_angle_deg", "Direction of the hand from the start at the largest recorded speed, counterclockwise from the target",
     &TrialMeasures::handAngle, "hand angle at peak speed (°)", 1, 1},
    {"hand_angle_at_radius_deg", "The same where the hand first reaches the target's distance from the start; empty where it does not",
     &TrialMeasures::handAngleAtRadius, "hand angle at the target's radius (°)", 1, 1},
    {"channel_leak_m", "Largest distance of the hand from the line of a channel; empty in other trials", &TrialMeasures::channelLeak,
     "leak of the channel (mm)", 1e3, 1},
    {"adaptation_percent",
     "Force against a channel's wall as a share of that which would cancel the trained field; empty in other trials and before the first field",
     &TrialMeasures::adaptation, "adaptation (%)", 1, 1},
    {"adaptation_r2", "R² of that share, without an intercept", &TrialMeasures::adaptationR2, "R² of the adaptation", 1, 2},
};

std::vector<Vec3> filteredVelocity(const std::vector<Vec3>& position, double rate, double cutoff) {
  std::vector<Vec3> velocity(position.size());
  std::vector<double> x(position.size());
  for (double Vec3::*component : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = position[i].*component;
    // The velocity is filtered, not the position: a trial ends while the hand still moves, and the filter continues a signal beyond its
    // end by turning it about the end point, which keeps the slope of a velocity but would flatten that of a position.
    const std::vector<double> v = lowPass(differentiate(x, rate), rate, cutoff);
    for (std::size_t i = 0; i < x.size(); ++i) velocity[i].*component = v[i];
  }
  return velocity;
}

double alongPath(const TrialData& trial, const Vec3& velocity, std::size_t sample) {
  if (trial.along.empty()) return norm(velocity);
  return dot(velocity, trial.along[std::min(sample, trial.along.size() - 1)]);
}

std::size_t sampleAt(const TrialData& trial, double time, std::size_t size) {
  return static_cast<std::size_t>(std::clamp(std::round(time * trial.rate), 0.0, static_cast<double>(size - 1)));
}

double meanOf(const std::vector<double>& values, std::size_t first, std::size_t last) {
  double sum = 0;
  for (std::size_t i = first; i <= last; ++i) sum += values[i];
  return sum / static_cast<double>(last - first + 1);
}

double overshoot(const std::vector<Vec3>& positions, const Vec3& aim, const Vec3& along) {
  double farthest = 0;
  for (const Vec3& p : positions) farthest = std::max(farthest, dot(p - aim, along));
  return farthest;
}

/// The movement ends with the trial at the latest: what the hand does after the masses were judged to have arrived is no part of it. A
/// trial that ended because the hand never left the start has none, though a share of the peak speed of its trembling is soon found.
Movement findWithinTrial(const TrialData& trial, const OnsetOptions& options, TrialSignals& signals) {
  const bool stayed = trial.result.reason == trial::Reason::NoOnset || trial.result.reason == trial::Reason::NoStart ||
                      (trial.catchTrial && !std::isfinite(trial.taskOnset));
  if (stayed) return {};
  const double taskEnd = trial.taskEnd - trial.first, taskOnset = trial.taskOnset - trial.first;  // since sample 0
  if (!std::isfinite(taskEnd)) return options.rule == OnsetRule::Task ? Movement{} : findMovement(signals.speed, trial.rate, options);
  // Rows are 10 ms apart, the trial ends between two of them; where the next was never taken it is continued in a straight line.
  const auto last = static_cast<std::size_t>(std::max(0.0, std::ceil(taskEnd * trial.rate - 1e-9)));
  for (auto* signal : {&signals.speed, &signals.handVelocity, &signals.objectVelocity})
    if (signal->size() == last && last >= 2) signal->push_back(2 * signal->back() - (*signal)[last - 2]);
  if (!signals.speed.empty()) signals.speed.back() = std::max(0.0, signals.speed.back());
  if (options.rule == OnsetRule::Task) return movementWithin(signals.speed, trial.rate, taskOnset, taskEnd);
  const std::span<const double> inside(signals.speed.data(), std::min(signals.speed.size(), last + 1));
  Movement movement = findMovement(inside, trial.rate, options);
  movement.offset = std::min(movement.offset, taskEnd);
  movement.peakTime = std::min(movement.peakTime, movement.offset);
  return movement;
}

/// Ends of the movement that were moved by hand hold in place of the rule's. Marks with nothing of the record between them leave
/// no movement.
void useMarks(const TrialData& trial, TrialSignals& signals) {
  const Movement& found = signals.movement;
  const auto either = [&](double marked, double own) { return std::isfinite(marked) ? marked - trial.first : own; };
  const int marks = std::isfinite(trial.markedOnset) + std::isfinite(trial.markedOffset);
  if (marks == 0 || (marks == 1 && !found.found)) return;
  const double longest = static_cast<double>(signals.speed.size() - 1) / trial.rate;
  const double onset = std::clamp(either(trial.markedOnset, found.onset), 0.0, longest);
  const double offset = std::clamp(either(trial.markedOffset, found.offset), 0.0, longest);
  signals.movement = onset < offset ? movementWithin(signals.speed, trial.rate, onset, offset) : Movement{};
}

}  // namespace

std::span<const Measure> measures() { return kMeasures; }

TrialSignals computeSignals(const TrialData& trial, const MeasureOptions& options) {
  TrialSignals signals;
  const std::vector<Vec3> velocity = filteredVelocity(trial.hand, trial.rate, options.cutoff);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    signals.speed.push_back(norm(velocity[i]));
    signals.handVelocity.push_back(alongPath(trial, velocity[i], i));
  }
  for (std::size_t i = 0; i < trial.objectVelocity.size(); ++i)
    signals.objectVelocity.push_back(alongPath(trial, trial.objectVelocity[i], i));
  signals.movement = findWithinTrial(trial, options.onset, signals);
  useMarks(trial, signals);
  // A closed curve leads to its target either way round.
  if (trial.closed && std::accumulate(signals.handVelocity.begin(), signals.handVelocity.end(), 0.0) < 0) {
    signals.otherWay = true;
    for (auto* along : {&signals.handVelocity, &signals.objectVelocity})
      for (double& v : *along) v = -v;
  }
  return signals;
}

TrialMeasures computeMeasures(const TrialData& trial, const TrialSignals& signals) {
  TrialMeasures m;
  m.movementTime = trial.taskEnd - trial.taskOnset;
  measureAcross(trial, m);
  m.peakForce = trial.peakForce;
  m.meanForce = trial.meanForce;
  const Movement& move = signals.movement;
  if (!move.found) return m;
  m.onset = trial.first + move.onset;
  m.offset = trial.first + move.offset;
  m.duration = move.duration();
  m.beforeGo = m.onset < trial.goTime;
  if (!m.beforeGo) m.reactionTime = m.onset - trial.goTime;
  m.peakSpeed = move.peak;
  m.timeToPeak = move.peakTime - move.onset;
  m.timeToPeakPercent = 100 * m.timeToPeak / m.duration;
  const double slowing = move.offset - move.peakTime;  // [s]
  m.symmetryRatio = slowing > 0.5 / trial.rate ? m.timeToPeak / slowing : kNotMeasured;

  const std::size_t first = sampleAt(trial, move.onset, signals.speed.size());
  const std::size_t last = sampleAt(trial, move.offset, signals.speed.size());
  const std::span<const double> speed(signals.speed.data() + first, last - first + 1);
  m.speedPeaks = static_cast<double>(countPeaks(speed));
  m.sparc = computeSparc(speed, trial.rate);
  m.ldlj = computeLogDimensionlessJerk(speed, trial.rate);
  // The integral of the filtered speed: tremor and noise of single samples would lengthen a sum of distances.
  m.pathLength = 0;
  for (std::size_t i = first; i < last; ++i) m.pathLength += 0.5 * (signals.speed[i] + signals.speed[i + 1]) / trial.rate;

  const Vec3 asked = trial.target - trial.start;
  m.handEndpointError = norm(trial.hand[std::min(last, trial.hand.size() - 1)] - trial.hand.front() - asked);
  if (!trial.object.empty()) {
    const std::size_t end =
        std::isfinite(trial.taskEnd) ? sampleAt(trial, trial.taskEnd - trial.first, trial.object.size()) : trial.object.size() - 1;
    m.objectEndpointError = norm(trial.object[end] - trial.target);
  }
  if (trial.along.size() == 1) {
    m.handOvershoot = overshoot(trial.hand, trial.hand.front() + asked, trial.along.front());
    m.objectOvershoot = overshoot(trial.object, trial.target, trial.along.front());
  }
  if (!std::isfinite(m.peakForce) && !trial.force.empty()) {
    m.peakForce = *std::max_element(trial.force.begin(), trial.force.end());
    m.meanForce = meanOf(trial.force, first, std::min(last, trial.force.size() - 1));
  }
  return m;
}

}  // namespace reachlab::analysis
