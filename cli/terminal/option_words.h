#pragma once
#include <string>
#include <vector>

#include "base/fault.h"

namespace reachlab::cli {

/// The option for `key` of a request ("disk_reserve" is `--disk-reserve`). Empty where there is no such option.
std::string optionOf(const std::string& key);

/// The parts of an option's value between its commas. Each may be empty, the last one too.
std::vector<std::string> partsBetweenCommas(const std::string& text);

/// Rewords faults for the command line. A value that is in no file came from an option, and the fault names the option.
std::vector<Fault> inOptionWords(std::vector<Fault> faults);

}  // namespace reachlab::cli
