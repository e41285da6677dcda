#include "tests/devices/fakes/fake_dhd.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

namespace reachlab::test {
namespace {

constexpr int kMost = 4;
FakeDhd devices[kMost];
thread_local int last = 0;  // as documented: of the thread that asks

int countAtTheStart() {
  const char* count = std::getenv("FAKE_DHD_DEVICES");
  return count != nullptr ? std::atoi(count) : 1;
}
std::atomic<int> connected{countAtTheStart()};

double secondsSinceTheStart() {
  static const auto begin = std::chrono::steady_clock::now();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

bool isTakenAway(int id) {
  const char* after = std::getenv("FAKE_DHD_LOST_AFTER");
  return after != nullptr && id == connected - 1 && secondsSinceTheStart() > std::atof(after);
}

int answer(int id) {
  if (id < 0 || id >= connected) return last = 5, -1;
  FakeDhd& device = devices[id];
  if (device.callsUntilFailure >= 0 && device.callsUntilFailure-- == 0) return last = 2, -1;
  if (const int once = device.failOnce.exchange(0); once != 0) return last = once, -1;
  if (const int error = device.error; error != 0) return last = error, -1;
  if (isTakenAway(id)) return last = 2, -1;
  return 0;
}

// Along the world's x (its own y) from -0.1 m to 0.1 m by a minimum-jerk law of 1.35 s, again and again.
void moveAlone(FakeDhd& device) {
  const double t = std::fmod(secondsSinceTheStart(), 4.0) - 1.5, s = t <= 0 ? 0 : t >= 1.35 ? 1 : t / 1.35;
  device.position[1] = t > 2.2 ? 0.1 - 0.2 * (t - 2.2) / 0.3 : -0.1 + 0.2 * s * s * s * (10 + s * (6 * s - 15));
}

}  // namespace

FakeDhd& fakeDhd(int id) { return devices[id]; }
std::atomic<int>& fakeDhdCount() { return connected; }

void resetFakeDhd() {
  connected = 1;
  for (FakeDhd& device : devices) std::construct_at(&device);
}

}  // namespace reachlab::test

using namespace reachlab::test;

extern "C" {

int dhdGetDeviceCount() { return fakeDhdCount(); }
int dhdOpenID(char id) {
  if (answer(id) < 0) return -1;
  fakeDhd(id).open = true;
  return id;
}
int dhdClose(char id) {
  FakeDhd& device = fakeDhd(id);
  device.open = false;
  if (const char* diary = std::getenv("FAKE_DHD_DIARY")) {
    const double now = std::hypot(device.force[0].load(), device.force[1].load(), device.force[2].load());
    std::ofstream(diary, std::ios::app) << int{id} << ' ' << device.most << ' ' << now << '\n';
  }
  return 0;
}
int dhdStop(char id) {
  fakeDhd(id).forceOn = false;
  return 0;
}
int dhdEnableForce(unsigned char on, char id) {
  if (answer(id) < 0) return -1;
  fakeDhd(id).forceOn = on != 0;
  return 0;
}
int dhdGetPosition(double* x, double* y, double* z, char id) {
  FakeDhd& device = fakeDhd(id);
  while (device.hangs) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (answer(id) < 0) return -1;
  if (device.sameAgain) return 1;
  if (std::getenv("FAKE_DHD_ALONE") != nullptr) moveAlone(device);
  *x = device.position[0], *y = device.position[1], *z = device.position[2];
  return 0;
}
int dhdSetForce(double x, double y, double z, char id) {
  if (answer(id) < 0) return -1;
  FakeDhd& device = fakeDhd(id);
  ++device.forces;
  device.force[0] = x, device.force[1] = y, device.force[2] = z;
  if (const double size = std::hypot(x, y, z); size > device.most) device.most = size;
  return 2;  // "motor saturated": told, and no error
}
int dhdEnableExpertMode() { return 0; }
int dhdSetWatchdog(unsigned char units, char id) {
  if (fakeDhd(id).watchdog < 0) return -1;
  fakeDhd(id).watchdog = units;
  return 0;
}
int dhdErrorGetLast() { return last; }
const char* dhdErrorGetLastStr() { return last == 5 ? "no device found" : last == 2 ? "communication error" : "other"; }
int dhdGetSystemType(char id) { return fakeDhd(id).type; }
const char* dhdGetSystemName(char) { return "omega.3"; }
int dhdGetSerialNumber(std::uint16_t* serial, char id) {
  if (!fakeDhd(id).tellsSerial) return -1;
  *serial = static_cast<std::uint16_t>(4711 + id);
  return 0;
}
std::uint32_t dhdGetButtonMask(char) { return 1; }
double dhdGetMaxForce(char id) { return fakeDhd(id).maxForce; }
int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  if (answer(id) < 0) return -1;
  const FakeDhd& device = fakeDhd(id);
  *x = device.velocity[0], *y = device.velocity[1], *z = device.velocity[2];
  return 0;
}
}
