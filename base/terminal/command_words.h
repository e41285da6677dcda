#pragma once
#include <string>

/// Rules for every word of a command line, shared by the window's program and `reach`.
namespace reachlab {

/// Throws FaultError for an empty word, as `--data ""` and `--data=` give it: no option has an empty value.
void refuseEmptyWords(int argc, const char* const* argv);
/// The fault of a number's text, empty if it is valid. "nan" and "inf" are faults: they would read like defaults and would be recorded.
std::string finiteNumberFault(const std::string& text);
/// Without the zeros in front, by which a library would take 010 for eight.
std::string withoutLeadingZeros(const std::string& text);

}  // namespace reachlab
