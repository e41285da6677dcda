#pragma once
#include <span>
#include <vector>

/// Signals sampled evenly at `rate` [Hz]. Pure functions for any thread.
namespace reachlab::analysis {

/// Zero-lag Butterworth low-pass: forwards and backwards through one section, so that nothing is delayed and the gain is squared (-6 dB at
/// the cut-off). Both ends are continued by nine samples turned about the end point (odd extension). The section starts in its steady state.
/// Gustafsson 1996 gives another method for this purpose. A signal of one sample is returned unchanged. A signal below ten samples is
/// extended by fewer samples. A `cutoff` of 0 returns the signal unfiltered. Throws FaultError unless 0 <= cutoff < rate / 2, both in Hz.
std::vector<double> lowPass(std::span<const double> signal, double rate, double cutoff);

/// Time derivative by central differences of fourth order [unit/s]. Next to the ends the order is two, and at the ends they are one-sided.
/// Zeros for fewer than three samples.
std::vector<double> differentiate(std::span<const double> signal, double rate);

}  // namespace reachlab::analysis
