#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab {

/// Times whole ticks (device sample in, device force out, no device) of the bench's scenes (all when empty), prints a table and, unless
/// `json` is empty, writes the rows to that file. Throws UsageError for a scene of another name.
void runTickBench(const std::vector<std::string>& scenes, std::uint64_t ticks, const std::string& json);

}  // namespace reachlab
