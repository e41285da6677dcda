#pragma once
#include <string>
#include <vector>

#include "base/fault.h"

namespace reachlab::cli {

/// The option that gives what `key` means in a request ("disk_reserve" is `--disk-reserve`); empty where no option does.
std::string optionOf(const std::string& key);

/// Faults in the command line's words: what stands in no file was given by an option, and is told by its name.
std::vector<Fault> inOptionWords(std::vector<Fault> faults);

}  // namespace reachlab::cli
