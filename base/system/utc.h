#pragma once
#include <chrono>
#include <string>

namespace reachlab {

/// "2026-11-20T10:00:00.000Z". It is right before 1970, too, where a computer's clock may be.
std::string utcText(std::chrono::system_clock::time_point time);

}  // namespace reachlab
