#pragma once
#include <string>

namespace reachlab::cli {

/// A program that `reach` starts: beside it in a build folder, in libexec where it is installed. `what`: "the program that measures". Throws
/// ResourceError when it is in neither.
std::string findHelperProgram(const std::string& name, const std::string& command, const std::string& what);

}  // namespace reachlab::cli
