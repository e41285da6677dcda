#pragma once
#include <string>

#include "base/fault.h"

namespace CLI {
class App;
class Option;
class ParseError;
}  // namespace CLI

namespace reachlab {

/// A wrong command line as a fault in our words, with the proposal for a misspelt word. `app` is the parser that threw `error`.
Fault faultOf(const CLI::App& app, const CLI::ParseError& error);

/// The type of an option's value: "INT", "FLOAT", "TEXT", or empty for a switch.
std::string typeOf(const CLI::Option& option);
/// The allowed values of an option: "1 to 9", "more than 0", "F, M or O". Empty where all values of its type are allowed.
std::string allowedOf(const CLI::Option& option);

}  // namespace reachlab
