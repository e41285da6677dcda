#pragma once
#include <cstdint>

namespace reachlab::cli {

/// How often this thread has asked operator new for memory since it began. The program replaces operator new to count. Any thread.
std::uint64_t countAllocations() noexcept;

}  // namespace reachlab::cli
