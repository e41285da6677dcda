#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// A stand-in for the vendor's libHD.so with its public signatures: it keeps the rules (frames, handles, order), counts what breaks
/// them as errors of its own, and fails where it is told to. Linked into tests under the vendor's name, and loadable by the program.
namespace reachlab::test {

struct FakeHdDevice {
  double position[3] = {0, 0, 0};  // [mm]
  double force[3] = {0, 0, 0};     // [N] in effect since the last frame's end
  double velocity[3] = {0, 0, 0};  // [mm/s]
  int buttons = 0;
  int frames = 0;
  bool open = false, forceOutput = false, switchClosed = true;
};

/// An error that waits, and whose it is; converts from the bare code: whose is not told.
struct FakeHdError {
  FakeHdError(std::uint32_t c, std::uint32_t d = 0xFFFFFFFF) : code(c), device(d) {}
  std::uint32_t code, device;
};

struct FakeHd {
  std::map<std::string, FakeHdDevice> devices;    // by configuration name; "" is the default device
  std::vector<std::string> calls;                 // in order, without what is read
  std::map<std::string, std::uint32_t> failures;  // the next call of this name leaves this error
  std::vector<FakeHdError> errors;                // that wait
  int violations = 0;                             // of the documented rules
  bool schedulerRuns = false;
  std::uint32_t calibration = 0x5000, styles = 4, updatedBy = 0;  // styles that it knows, and the one that it was told
  double maxForce = 3.3, continuousForce = 0.88;                  // [N]
};
FakeHd& fakeHd();
/// As new: one default device.
void resetFakeHd();
/// Calls every scheduled callback once, as the servo loop does.
void stepFakeHd();
/// Calls every callback that was ever scheduled, as a library does that is late: after hdUnschedule, and with the device closed.
void callLateFakeHd();
/// The handle that a device was given last.
std::uint32_t fakeHdHandle(const std::string& name);

}  // namespace reachlab::test
