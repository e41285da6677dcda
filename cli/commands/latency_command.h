#pragma once
#include <CLI/CLI.hpp>

namespace reachlab::cli {

/// Like the commands of commands.h.
void addLatencyCommand(CLI::App& app, int& exitCode);

}  // namespace reachlab::cli
