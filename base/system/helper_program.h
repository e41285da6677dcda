#pragma once
#include <string>

namespace reachlab {

/// Finds a program that one of ours starts: beside it, in libexec of an installation, or in a neighbouring folder of the build tree.
/// `program` is the caller ("reach bench"), or the file that the helper is for. `what` describes the helper: "the program that measures".
/// Throws ResourceError if no folder has it.
std::string findHelperProgram(const std::string& name, const std::string& program, const std::string& what);

}  // namespace reachlab
