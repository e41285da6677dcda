#pragma once
#include <functional>
#include <string>
#include <vector>

namespace reachlab::bench {

/// The cost of a hand that comes as samples once a millisecond: the largest position error [m] at 100 Hz against the reference of the true
/// hand. The path goes through the newest `samples` positions (1: held for the step, 2: line, 3: parabola, 4: cubic). Its velocity is that
/// of the same polynomial at the newest sample, so that only positions are measured.
struct SampledRow {
  std::string scene, method;
  int samples = 4;
  double clean = 0;      // [m] samples of the true hand
  double noise = 0;      // [m] with white noise of 10 um (standard deviation, each axis)
  double quantised = 0;  // [m] rounded to multiples of 60 um
};

inline constexpr double kNoise = 10e-6;    // [m]
inline constexpr double kQuantum = 60e-6;  // [m]

/// S1, S2a, S3 and S6 by every method that accepts the scene. The noise has a fixed seed, so the rows are the same every time.
std::vector<SampledRow> measureSampledHand(const std::function<void(const std::string&)>& progress);
std::string formatSampledHand(const std::vector<SampledRow>& rows);

}  // namespace reachlab::bench
