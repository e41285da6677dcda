#pragma once
#include <exception>
#include <string>

namespace reachlab {

/// 70 (EX_SOFTWARE of sysexits.h): an exception that nobody foresaw, a defect.
inline constexpr int kOwnFaultExit = 70;

/// What an exception says to a person, and the number that `reach` ends with: our own (base/error.h) as they stand, those of the standard
/// library and of other libraries in words of ours, for theirs name classes and functions. Any thread.
struct Ending {
  std::string sentence;
  int exitCode = 0;
};
Ending endingOf(const std::exception& error);

/// What no catch reaches (no memory before main, an exception out of a thread) ends the program with a sentence and its number, too, and not with
/// an abort. In force before main in every program that calls this; the call itself does nothing more.
void endOnUncaught() noexcept;

}  // namespace reachlab
