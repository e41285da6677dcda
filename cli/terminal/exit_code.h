#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace reachlab::cli {

/// What `work` returns, or the number behind what it throws (error.h), with the message on stderr. `app` shows its own help and version.
int exitCodeOf(CLI::App& app, const std::function<int()>& work);

}  // namespace reachlab::cli
