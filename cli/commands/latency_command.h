#pragma once
#include <CLI/CLI.hpp>

namespace reachlab::cli {

/// As those of commands.h.
void addLatencyCommand(CLI::App& app, int& exitCode);

}  // namespace reachlab::cli
