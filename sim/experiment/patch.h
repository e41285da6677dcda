#pragma once
#include <span>
#include <string>

namespace reachlab::experiment {

/// One change to a file: `coupling.stiffness_n_per_m`, `object.masses_kg[2]` (from 0), `object.masses_kg[*]` (each element).
struct Patch {
  std::string path;
  std::string value;  // as JSON
};

/// The file's text with these changes, comments gone. A key that is not there is made, so that the file's reader judges it; an element
/// that is not there is refused. Throws FaultError under the patch's path.
std::string patchedText(const std::string& text, const std::string& file, std::span<const Patch> patches);

}  // namespace reachlab::experiment
