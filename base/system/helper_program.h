#pragma once
#include <string>

namespace reachlab {

/// A program that one of ours starts: beside it, in libexec where it is installed, or in a neighbour's folder of the build tree. `program`: who
/// asks ("reach bench"), or the file that it is for; `what`: "the program that measures". Throws ResourceError when it is in none of them.
std::string findHelperProgram(const std::string& name, const std::string& program, const std::string& what);

}  // namespace reachlab
