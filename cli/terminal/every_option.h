#pragma once
#include <CLI/CLI.hpp>

/// Rules for the options of every command, so that no command can forget them.
namespace reachlab::cli {

/// To be called after parsing, before the command works. Throws FaultError where `--out` or `--figure` names an input of the command or a
/// recording. Throws it too where `--out`, `--figure`, `--data` or `--backup` lies in a dataset's `sourcedata`.
void checkOutputs(const CLI::App& app);

}  // namespace reachlab::cli
