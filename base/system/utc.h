#pragma once
#include <chrono>
#include <string>

namespace reachlab {

/// "2026-11-20T10:00:00.000Z"; also right before 1970, where a computer's clock may stand.
std::string utcText(std::chrono::system_clock::time_point time);

}  // namespace reachlab
