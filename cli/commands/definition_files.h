#pragma once
#include <string>
#include <vector>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"

namespace reachlab::cli {

/// The definitions of the user's folder. Prints a warning on stderr for each file that cannot be read, and leaves the file out.
std::vector<constraints::Definition> ownDefinitions();

/// The constraint of a definition at its defaults. It must be usable at both ends of each shape parameter as well. Throws FaultError with the
/// faults at their places in the text of the file.
constraints::Constraint makeAtAllShapes(const constraints::Definition& definition, const std::string& text, const std::string& file);

}  // namespace reachlab::cli
