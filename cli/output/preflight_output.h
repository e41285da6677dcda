#pragma once
#include <string>
#include <vector>

#include "devices/preflight/preflight.h"

namespace reachlab::cli {

/// One line per finding, warnings first.
std::string preflightText(const std::vector<devices::PreflightLine>& lines);
/// `[{hand, name, verdict, asked, limit, unit, sentence, remedy}]`.
std::string preflightJson(const std::vector<devices::PreflightLine>& lines);

}  // namespace reachlab::cli
