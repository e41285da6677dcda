#pragma once
#include <CLI/CLI.hpp>

namespace reachlab::cli {

void addMergeCommand(CLI::App& app, int& exitCode);

}  // namespace reachlab::cli
