#pragma once
#include <atomic>

/// A stand-in for the vendor's libdrd.so with the public signatures of its DHD calls. Linked into tests, and loadable by the program: there
/// FAKE_DHD_DEVICES says how many there are, FAKE_DHD_ALONE=1 moves their handles, FAKE_DHD_LOST_AFTER takes the last of them away after so
/// many seconds, and each tells FAKE_DHD_DIARY, a file, what it felt when it is closed.
namespace reachlab::test {

struct FakeDhd {
  std::atomic<double> position[3]{};  // [m], the device's axes
  std::atomic<double> force[3]{};     // [N] last set
  std::atomic<double> most{0};        // [N] of its norm so far
  std::atomic<bool> open{false}, forceOn{false};
  std::atomic<int> forces{0};
  std::atomic<int> error{0};               // != 0: every call from now on fails with it
  std::atomic<int> failOnce{0};            // the next call fails with it
  std::atomic<int> callsUntilFailure{-1};  // how many calls succeed before one fails with a communication error; -1: none fails
  std::atomic<bool> hangs{false};          // dhdGetPosition does not return while it is set
  std::atomic<bool> sameAgain{false};      // dhdGetPosition gives the sample of before, and says so (time guard)
  std::atomic<int> watchdog{0};            // [125 us] dhdSetWatchdog; -1: it refuses
  std::atomic<bool> tellsSerial{true};     // false: dhdGetSerialNumber fails
  std::atomic<double> velocity[3]{};       // [m/s], the device's axes
  std::atomic<int> type{33};               // dhdGetSystemType
  std::atomic<double> maxForce{-1};        // [N] dhdGetMaxForce
};
FakeDhd& fakeDhd(int id = 0);  // 0 to 3
/// How many of them are connected.
std::atomic<int>& fakeDhdCount();
void resetFakeDhd();

}  // namespace reachlab::test
