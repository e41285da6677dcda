#pragma once
#include <exception>
#include <string>

namespace reachlab {

/// 70 (EX_SOFTWARE of sysexits.h): an exception that nobody foresaw, a defect.
inline constexpr int kOwnFaultExit = 70;

/// The sentence that an exception shows to a person, and the exit code of `reach`. Messages of our exceptions (base/error.h) are shown
/// unchanged. Exceptions of the standard library and of other libraries get a sentence from here, because theirs name classes and
/// functions. Any thread.
struct ErrorReport {
  std::string sentence;
  int exitCode = 0;
};
ErrorReport errorReportOf(const std::exception& error);

/// Makes an uncaught exception (no memory before main, an exception out of a thread) end the program with a sentence and its exit code
/// instead of an abort. Every program that calls this has it in force before main. The call itself has no further effect.
void endOnUncaught() noexcept;

}  // namespace reachlab
