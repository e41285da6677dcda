#include "tests/devices/fakes/fake_dhd.h"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace reachlab::test {
namespace {

FakeDhd state;
std::atomic<int> last{0};

int answer() {
  if (state.callsUntilFailure >= 0 && state.callsUntilFailure-- == 0) return last = 2, -1;
  if (const int once = state.failOnce.exchange(0); once != 0) return last = once, -1;
  if (const int error = state.error; error != 0) return last = error, -1;
  return 0;
}

}  // namespace

FakeDhd& fakeDhd() { return state; }

void resetFakeDhd() {
  state.count = 1;
  for (int i = 0; i < 3; ++i) state.position[i] = 0, state.force[i] = 0;
  state.open = state.forceOn = state.hangs = false;
  state.callsUntilFailure = -1;
  state.positions = state.forces = state.error = state.failOnce = 0;
}

}  // namespace reachlab::test

using namespace reachlab::test;

extern "C" {

int dhdGetDeviceCount() { return fakeDhd().count; }
int dhdOpenID(char id) {
  if (id < 0 || id >= fakeDhd().count) return last = 5, -1;
  if (answer() < 0) return -1;
  fakeDhd().open = true;
  return id;
}
int dhdClose(char) {
  fakeDhd().open = false;
  return 0;
}
int dhdStop(char) {
  fakeDhd().forceOn = false;
  return 0;
}
int dhdEnableForce(unsigned char on, char) {
  if (answer() < 0) return -1;
  fakeDhd().forceOn = on != 0;
  return 0;
}
int dhdGetPosition(double* x, double* y, double* z, char) {
  while (fakeDhd().hangs) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (answer() < 0) return -1;
  ++fakeDhd().positions;
  *x = fakeDhd().position[0], *y = fakeDhd().position[1], *z = fakeDhd().position[2];
  return 0;
}
int dhdSetForce(double x, double y, double z, char) {
  if (answer() < 0) return -1;
  ++fakeDhd().forces;
  fakeDhd().force[0] = x, fakeDhd().force[1] = y, fakeDhd().force[2] = z;
  return 2;  // "motor saturated": told, and no error
}
int dhdErrorGetLast() { return last; }
const char* dhdErrorGetLastStr() { return last == 5 ? "no device found" : last == 2 ? "communication error" : "other"; }
int dhdGetSystemType(char) { return 33; }
const char* dhdGetSystemName(char) { return "omega.3"; }
int dhdGetSerialNumber(std::uint16_t* serial, char) {
  *serial = 4711;
  return 0;
}
std::uint32_t dhdGetButtonMask(char) { return 1; }
bool dhdHasWrist(char) { return false; }
double dhdGetMaxForce(char) { return -1; }
}
