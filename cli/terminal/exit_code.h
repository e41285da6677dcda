#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace reachlab::cli {

/// Returns the result of `work`, or the code of the error that it throws (error.h), with the message on stderr. `app` shows its own help
/// and version.
int exitCodeOf(CLI::App& app, const std::function<int()>& work);

}  // namespace reachlab::cli
