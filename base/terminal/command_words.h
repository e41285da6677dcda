#pragma once
#include <CLI/CLI.hpp>

/// Rules for every word of a command line, shared by the window's program and `reach`.
namespace reachlab {

/// Throws FaultError for an empty word, as `--data ""` and `--data=` give it: no option has an empty value.
void refuseEmptyWords(int argc, const char* const* argv);
/// Adds to every option of `command` and its commands: a number is finite, and a whole number is read in decimal (010 is ten).
void checkEveryNumber(CLI::App& command);

}  // namespace reachlab
