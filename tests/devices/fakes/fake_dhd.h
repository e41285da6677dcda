#pragma once
#include <atomic>
#include <string>

/// A stand-in for the vendor's libdrd.so with the public signatures of its DHD calls. Linked into tests, and loadable by the program.
namespace reachlab::test {

struct FakeDhd {
  std::atomic<int> count{1};
  std::atomic<double> position[3]{};  // [m], the device's axes
  std::atomic<double> force[3]{};     // [N] last set
  std::atomic<bool> open{false}, forceOn{false};
  std::atomic<int> positions{0}, forces{0};
  std::atomic<int> error{0};               // != 0: every call from now on fails with it
  std::atomic<int> failOnce{0};            // the next call fails with it
  std::atomic<int> callsUntilFailure{-1};  // how many calls succeed before one fails with a communication error; -1: none fails
  std::atomic<bool> hangs{false};          // dhdGetPosition does not return while it is set
};
FakeDhd& fakeDhd();
void resetFakeDhd();

}  // namespace reachlab::test
