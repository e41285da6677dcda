#pragma once
#include <stdexcept>

/// What cannot start or be read is thrown as one of these or as a FaultError (base/fault.h; 2: wrong usage or a bad file), caught in
/// `main` and in the window's slots, and shown as it stands: the message says what, where, and what to do. `reach` ends with the number
/// behind each.
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
