#pragma once
#include <cstdint>

/// The time that a test sets by hand, in place of the system's clock.
namespace reachlab::devices {

inline constexpr std::int64_t kMs = 1'000'000;    // [ns]
inline thread_local std::int64_t inventedNs = 0;  // only the test's thread has it
inline std::int64_t inventedNow() { return inventedNs; }

}  // namespace reachlab::devices
