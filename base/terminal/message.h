#pragma once
#include <string>
#include <vector>

#include "base/fault.h"

namespace reachlab {

/// A message as compilers write it: `FILE:LINE:COLUMN: error: KEY: what is wrong`, then that line of the file with a caret below the
/// column, then `help:` with the proposal and what is allowed. Parts that a fault does not have are left out. The file is read again for
/// its line. `severity` is "error" or "warning". Ends with a line end.
std::string messageOf(const Fault& fault, const std::string& severity = "error");
/// The messages of several faults, one after another.
std::string messageOf(const std::vector<Fault>& faults);

/// The same for the sentences of an error without a key. In every sentence a semicolon separates the problem from its remedies: `what; allowed:
/// …`. Each line of the text becomes a message.
std::string messageOf(const std::string& text);

}  // namespace reachlab
