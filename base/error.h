#pragma once
#include <stdexcept>

/// What cannot start or be read is thrown as one of these, caught in `main` and in the window's slots, and shown as it stands: the
/// message says what, where, and what to do. `reach` ends with the number behind each.
namespace reachlab {

struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// 2: wrong usage or a bad file; one line a fault, `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
struct UsageError : Error {
  using Error::Error;
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
