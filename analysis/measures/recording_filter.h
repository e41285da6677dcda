#pragma once
#include <span>
#include <vector>

namespace reachlab::analysis {

/// The zero-lag Butterworth filter of a recording, applied to a movement that is known as a function of time.
///   |H(f)|^2 = 1 / (1 + (tan(pi f / rate) / tan(pi cutoff / rate))^4) for f < rate / 2, and 0 above
/// Immutable, for any thread.
class RecordingFilter {
 public:
  /// `cutoff` [Hz], with 0 for no filter, and `rate` [Hz] of the recording. Throws FaultError unless 0 <= cutoff < rate / 2.
  RecordingFilter(double cutoff, double rate);

  /// The lag [s] beyond which the kernel is below 1e-6 of its peak. 0 without a filter.
  double reach() const { return reach_; }

  /// `signal` is known on [0, duration] at equally spaced instants, its ends being inner limits (it may jump there), and is 0 elsewhere.
  /// The filtered signal at the same instants and `margin` steps of the same size on either side of them.
  std::vector<double> apply(std::span<const double> signal, double duration, std::size_t margin) const;

 private:
  double gain(double frequency) const;  // |H(f)|^2, f >= 0 in Hz
  double kernel(double seconds) const;  // impulse response at a lag [1/s]
  double cutoff_ = 0, rate_ = 0, reach_ = 0, step_ = 0;
  std::vector<double> table_;  // kernel at 0, step_, 2 step_ … and a few beyond reach_
};

/// Weights of a sum over equally spaced samples that integrates to eighth order, in units of the spacing. They are Gregory's end
/// corrections of the trapezoidal rule. Fewer than 16 samples get the trapezoidal rule.
std::vector<double> gregoryWeights(std::size_t samples);

}  // namespace reachlab::analysis
