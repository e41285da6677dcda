#pragma once
#include <array>
#include <span>
#include <vector>

/// Signals sampled evenly at `rate` [Hz]. Pure functions; any thread.
namespace reachlab::analyze {

/// Second-order section y = (b0 x + b1 x' + b2 x'' - a1 y' - a2 y''), a0 = 1; primes are one and two samples back.
struct Biquad {
  std::array<double, 3> b{};
  std::array<double, 3> a{};
};

/// Butterworth low-pass of second order by the bilinear transform with its cut-off pre-warped: -3 dB at `cutoff` in one pass.
/// 0 < cutoff < rate / 2, both in Hz; throws UsageError otherwise.
Biquad butterworthLowPass(double cutoff, double rate);

/// Forwards and backwards through the section, so that nothing is delayed and the gain is squared (-6 dB at the cut-off). Both ends are
/// continued by nine samples turned about the end point, and the section starts in its steady state (Gustafsson 1996 serves the same
/// end; this is the common odd extension). Signals of one sample come back as they are; shorter than ten: extended by what there is.
std::vector<double> filterBothWays(const Biquad& section, std::span<const double> signal);

/// Zero-lag Butterworth low-pass; `cutoff` 0 returns the signal unfiltered.
std::vector<double> lowPass(std::span<const double> signal, double rate, double cutoff);

/// Time derivative by central differences of fourth order (second order next to the ends, one-sided second order at them).
/// [unit/s]; zeros for fewer than three samples.
std::vector<double> differentiate(std::span<const double> signal, double rate);

}  // namespace reachlab::analyze
