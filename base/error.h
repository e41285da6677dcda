#pragma once
#include <stdexcept>

/// Functions that cannot start or read throw a child of Error: one of these two, or FaultError for wrong usage or a bad file
/// (base/fault.h). `main` and the window's slots catch it and show its message unchanged. The message names the problem, its location and
/// the remedy. `reach` ends with the exit code that is given at each type. FaultError has 2.
namespace reachlab {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// 3: a device, a disk or another resource can't be had.
struct ResourceError : Error {
  using Error::Error;
};
/// 4: the computation was refused (singular, too stiff, uncontrollable …), with the reason.
struct RefusedError : Error {
  using Error::Error;
};

}  // namespace reachlab
