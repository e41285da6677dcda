#pragma once
#include <string>
#include <vector>

namespace reachlab::test {

/// The formulas that were compiled since the last call, "x | y | z", in order; from any thread. Of a program that is linked with
/// REACHLAB_COUNT_COMPILATIONS (tests/CMakeLists.txt): the linker puts the counter before constraints::compileFormula, and nothing of it is
/// in the programs that are shipped.
std::vector<std::string> takeCompilations();

}  // namespace reachlab::test
