#pragma once
#include <CLI/CLI.hpp>

/// What holds for the words of every command, so that no command can forget it.
namespace reachlab::cli {

/// Adds to every option of `app` and its commands: a number is finite, and a whole number is read in decimal (010 is ten).
void checkEveryNumber(CLI::App& app);

/// After parsing, before the command works: throws FaultError where `--out` or `--figure` names one of the command's own inputs or a
/// recording, and where `--out`, `--figure`, `--data` or `--backup` lies in a dataset's `sourcedata`.
void checkOutputs(const CLI::App& app);

}  // namespace reachlab::cli
