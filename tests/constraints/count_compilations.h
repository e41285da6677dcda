#pragma once
#include <string>
#include <vector>

namespace reachlab::test {

/// The formulas that were compiled since the last call, "x | y | z", in order; from any thread. Of a program that
/// has count_compilations.cpp (tests/CMakeLists.txt).
std::vector<std::string> takeCompilations();

}  // namespace reachlab::test
