#pragma once
#include <span>
#include <vector>

#include "base/math/butterworth.h"

/// Signals sampled evenly at `rate` [Hz]. Pure functions; any thread.
namespace reachlab::analysis {

/// Forwards and backwards through the section, so that nothing is delayed and the gain is squared (-6 dB at the cut-off). Both ends are
/// continued by nine samples turned about the end point, and the section starts in its steady state (Gustafsson 1996 serves the same
/// end; this is the common odd extension). Signals of one sample come back as they are; shorter than ten: extended by what there is.
std::vector<double> filterBothWays(const Biquad& section, std::span<const double> signal);

/// Zero-lag Butterworth low-pass; `cutoff` 0 returns the signal unfiltered. 0 <= cutoff < rate / 2, both in Hz; throws FaultError otherwise.
std::vector<double> lowPass(std::span<const double> signal, double rate, double cutoff);

/// Time derivative by central differences of fourth order (second order next to the ends, one-sided second order at them).
/// [unit/s]; zeros for fewer than three samples.
std::vector<double> differentiate(std::span<const double> signal, double rate);

}  // namespace reachlab::analysis
