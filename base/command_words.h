#pragma once
#include <string>

/// What holds for every word of a command line, in the window's program as in `reach`.
namespace reachlab {

/// Throws FaultError for an empty word, as `--data ""` and `--data=` give it: no option has an empty value.
void refuseEmptyWords(int argc, const char* const* argv);
/// What is wrong with a number's text, empty when nothing is: "nan" and "inf" read like defaults, and would be recorded.
std::string finiteNumberFault(const std::string& text);
/// Without the zeros in front, by which a library would take 010 for eight.
std::string withoutLeadingZeros(const std::string& text);

}  // namespace reachlab
