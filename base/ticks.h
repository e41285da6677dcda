#pragma once
#include <cstdint>

/// The haptic tick: 1 ms, the clock of trials, recordings and exports. Any thread.
namespace reachlab {

inline constexpr std::int64_t kTickNs = 1'000'000;
inline constexpr double kTicksPerSecond = 1000;
inline constexpr double kTickSeconds = 0.001;  // [s] the time step of everything that advances once a tick

/// Ticks in seconds, rounded once: 1350 ticks are the double that is written 1.35 (a product with kTickSeconds may miss it by a bit).
constexpr double secondsOf(double ticks) noexcept { return ticks / kTicksPerSecond; }
constexpr double secondsOf(std::uint64_t ticks) noexcept { return secondsOf(static_cast<double>(ticks)); }
constexpr double secondsOf(int ticks) noexcept { return secondsOf(static_cast<double>(ticks)); }
/// Time between two ticks. The second tick may be earlier than the first.
constexpr double secondsBetween(std::uint64_t from, std::uint64_t to) noexcept {
  return secondsOf(static_cast<double>(to) - static_cast<double>(from));
}

}  // namespace reachlab
