#include "tests/devices/fakes/fake_hd.h"

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

namespace reachlab::test {
namespace {

struct Scheduled {
  unsigned long handle;
  std::uint32_t (*callback)(void*);
  void* data;
};

FakeHd state;
std::vector<Scheduled> scheduled, everScheduled;
std::vector<std::string> names;  // by handle
std::uint32_t current = 0xFFFFFFFF;
int openFrame = -1;
double pendingForce[3];
unsigned long nextHandle = 1;
std::recursive_mutex mutex;  // the servo loop's own lock
std::thread servo;
std::atomic<bool> servoStops{false};

bool fails(const char* call) {
  const auto at = state.failures.find(call);
  if (at == state.failures.end()) return false;
  state.errors.push_back({at->second, current});
  state.failures.erase(at);
  return true;
}

void breakRule(std::uint32_t error) {
  ++state.violations;
  state.errors.push_back({error, current});
}

FakeHdDevice* currentDevice() {
  if (current >= names.size()) {
    breakRule(0x0104);
    return nullptr;
  }
  return &state.devices[names[current]];
}

// By themselves, as the program meets it: hand and force from the environment's script are not needed, a resting stylus is enough.
bool runsAlone() { return std::getenv("FAKE_HD_ALONE") != nullptr; }

// A stylus that is moved along x from -0.1 m to 0.1 m by a minimum-jerk law of 1.35 s, 1.5 s after the start, again and again.
void moveAlone(FakeHdDevice& device, std::chrono::steady_clock::time_point begin) {
  const double t = std::fmod(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 4.0) - 1.5;
  const double s = t <= 0 ? 0 : t >= 1.35 ? 1 : t / 1.35;
  device.position[0] = -100 + 200 * s * s * s * (10 + s * (6 * s - 15));
  if (t > 2.2) device.position[0] = 100 - 200 * (t - 2.2) / 0.3;
  const char* lost = std::getenv("FAKE_HD_LOST_AFTER");
  if (lost != nullptr && std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > std::atof(lost))
    state.errors.push_back(0x0302);
}

}  // namespace

FakeHd& fakeHd() { return state; }

void resetFakeHd() {
  const std::lock_guard lock(mutex);
  state = {};
  state.devices[""] = {};
  scheduled.clear();
  everScheduled.clear();
  names.clear();
  current = 0xFFFFFFFF;
  openFrame = -1;
}

void stepFakeHd() {
  const std::lock_guard lock(mutex);
  if (!state.schedulerRuns) return;
  for (const Scheduled& one : std::vector<Scheduled>(scheduled))
    if (one.callback(one.data) == 0) std::erase_if(scheduled, [&](const Scheduled& other) { return other.handle == one.handle; });
}

void callLateFakeHd() {
  const std::lock_guard lock(mutex);
  for (const Scheduled& one : std::vector<Scheduled>(everScheduled)) one.callback(one.data);
}

std::uint32_t fakeHdHandle(const std::string& name) {
  const std::lock_guard lock(mutex);
  for (std::size_t i = names.size(); i-- > 0;)
    if (names[i] == name) return static_cast<std::uint32_t>(i);
  return 0xFFFFFFFF;
}

}  // namespace reachlab::test

using namespace reachlab::test;

extern "C" {

struct HDErrorInfo {
  std::uint32_t code;
  std::int32_t internal;
  std::uint32_t device;
};

std::uint32_t hdInitDevice(const char* name) {
  const std::lock_guard lock(mutex);
  const std::string key = name != nullptr ? name : "";
  state.calls.push_back("hdInitDevice:" + key);
  if (fails("hdInitDevice")) return 0xFFFFFFFF;
  // By themselves: the default device, and those that FAKE_HD_DEVICES names, with commas.
  const char* named = std::getenv("FAKE_HD_DEVICES");
  if (runsAlone() && (key.empty() || (named != nullptr && ("," + std::string(named) + ",").find("," + key + ",") != std::string::npos)))
    state.devices[key];
  const auto at = state.devices.find(key);
  if (at == state.devices.end()) {
    state.errors.push_back(0x0300);
    return 0xFFFFFFFF;
  }
  if (at->second.open) {
    state.errors.push_back(0x0301);
    return 0xFFFFFFFF;
  }
  at->second.open = true;
  names.push_back(key);
  current = static_cast<std::uint32_t>(names.size()) - 1;
  return current;
}

void hdDisableDevice(std::uint32_t handle) {
  const std::lock_guard lock(mutex);
  state.calls.push_back("hdDisableDevice");
  if (handle >= names.size() || !state.devices[names[handle]].open) return breakRule(0x0104);
  state.devices[names[handle]].open = false;
}

void hdMakeCurrentDevice(std::uint32_t handle) {
  const std::lock_guard lock(mutex);
  current = handle;
}

void hdBeginFrame(std::uint32_t handle) {
  const std::lock_guard lock(mutex);
  fails("hdBeginFrame");  // which device is current is hdMakeCurrentDevice's business alone
  if (openFrame >= 0) breakRule(0x0400);
  openFrame = static_cast<int>(handle);
  std::memset(pendingForce, 0, sizeof pendingForce);
}

void hdEndFrame(std::uint32_t handle) {
  const std::lock_guard lock(mutex);
  fails("hdEndFrame");
  if (openFrame != static_cast<int>(handle)) return breakRule(0x0401);
  openFrame = -1;
  if (FakeHdDevice* device = currentDevice()) {
    ++device->frames;
    for (int i = 0; i < 3; ++i) device->force[i] = device->forceOutput ? pendingForce[i] : 0;
  }
}

HDErrorInfo hdGetError() {
  const std::lock_guard lock(mutex);
  if (state.errors.empty()) return {0, 0, 0xFFFFFFFF};
  const FakeHdError error = state.errors.back();
  state.errors.pop_back();
  return {error.code, 0, error.device};
}

const char* hdGetErrorString(std::uint32_t code) {
  switch (code) {
    case 0x0200: return "HD_WARM_MOTORS";
    case 0x0203: return "HD_EXCEEDED_MAX_VELOCITY";
    case 0x0300: return "HD_DEVICE_FAULT";
    case 0x0301: return "HD_DEVICE_ALREADY_INITIATED";
    case 0x0302: return "HD_COMM_ERROR";
    case 0x0600: return "HD_INVALID_LICENSE";
    default: return "HD_OTHER";
  }
}

void hdEnable(std::uint32_t what) {
  const std::lock_guard lock(mutex);
  state.calls.push_back(what == 0x4000 ? "hdEnable:force" : "hdEnable");
  if (fails("hdEnable")) return;
  if (FakeHdDevice* device = currentDevice(); device != nullptr && what == 0x4000) device->forceOutput = true;
}
void hdDisable(std::uint32_t what) {
  const std::lock_guard lock(mutex);
  state.calls.push_back(what == 0x4000 ? "hdDisable:force" : "hdDisable");
  if (FakeHdDevice* device = currentDevice(); device != nullptr && what == 0x4000) {
    device->forceOutput = false;
    std::memset(device->force, 0, sizeof device->force);
  }
}

void hdGetDoublev(std::uint32_t what, double* values) {
  const std::lock_guard lock(mutex);
  if (fails("hdGetDoublev")) return;
  FakeHdDevice* device = currentDevice();
  if (device == nullptr) return;
  switch (what) {
    case 0x2050:
      if (openFrame < 0) breakRule(0x0402);
      std::memcpy(values, device->position, sizeof device->position);
      break;
    case 0x2051: std::memcpy(values, device->velocity, sizeof device->velocity); break;
    case 0x2551: {
      const double workspace[6] = {-80, -60, -35, 80, 60, 35};
      std::memcpy(values, workspace, sizeof workspace);
      break;
    }
    case 0x2603: *values = state.maxForce; break;
    case 0x2604: *values = state.continuousForce; break;
    default: state.errors.push_back(0x0100);
  }
}
void hdGetIntegerv(std::uint32_t what, std::int32_t* value) {
  const std::lock_guard lock(mutex);
  if (what != 0x2000) return state.errors.push_back(0x0100);
  if (const FakeHdDevice* device = currentDevice()) *value = device->buttons;
}
void hdGetBooleanv(std::uint32_t what, std::uint8_t* value) {
  const std::lock_guard lock(mutex);
  if (what != 0x2001) return state.errors.push_back(0x0100);
  if (const FakeHdDevice* device = currentDevice()) *value = device->switchClosed ? 1 : 0;
}
const char* hdGetString(std::uint32_t what) {
  const std::lock_guard lock(mutex);
  if (fails("hdGetString")) return nullptr;
  return what == 0x2501 ? "PHANToM Omni" : what == 0x2504 ? "SN7" : "";
}

void hdSetDoublev(std::uint32_t what, const double* values) {
  const std::lock_guard lock(mutex);
  if (fails("hdSetDoublev")) return;
  if (what != 0x2700) return state.errors.push_back(0x0100);
  if (openFrame < 0) return breakRule(0x0402);
  std::memcpy(pendingForce, values, sizeof pendingForce);
}

std::uint32_t hdCheckCalibration() { return state.calibration; }
std::uint32_t hdCheckCalibrationStyle() { return state.styles; }
void hdUpdateCalibration(std::uint32_t style) {
  state.updatedBy = style;
  state.calls.push_back("hdUpdateCalibration");
  if (state.calibration == 0x5001) state.calibration = 0x5000;
}

void hdStartScheduler() {
  const std::lock_guard lock(mutex);
  state.calls.push_back("hdStartScheduler");
  if (fails("hdStartScheduler")) return;
  state.schedulerRuns = true;
  if (!runsAlone()) return;
  servoStops = false;
  servo = std::thread([begin = std::chrono::steady_clock::now()] {
    // As the vendor's: before all else, where that is allowed.
    sched_param priority{};
    priority.sched_priority = 82;
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
    // What a scheduler may do wrong: never call, call twice, come 30 ms late every second.
    const bool never = std::getenv("FAKE_HD_NEVER") != nullptr, twice = std::getenv("FAKE_HD_TWICE") != nullptr,
               late = std::getenv("FAKE_HD_LATE") != nullptr;
    auto next = begin;
    for (int call = 1; !servoStops; ++call) {
      std::this_thread::sleep_until(next += std::chrono::milliseconds(late && call % 1000 == 0 ? 30 : 1));
      {
        const std::lock_guard inner(mutex);
        for (auto& [name, device] : state.devices) moveAlone(device, begin);
      }
      if (never) continue;
      stepFakeHd();
      if (twice) stepFakeHd();
    }
  });
}
void hdStopScheduler() {
  {
    const std::lock_guard lock(mutex);
    state.calls.push_back("hdStopScheduler");
    state.schedulerRuns = false;
  }
  servoStops = true;
  if (servo.joinable()) servo.join();
}
void hdSetSchedulerRate(unsigned long) {}

unsigned long hdScheduleAsynchronous(std::uint32_t (*callback)(void*), void* data, std::uint16_t) {
  const std::lock_guard lock(mutex);
  state.calls.push_back("hdScheduleAsynchronous");
  if (fails("hdScheduleAsynchronous")) return 0;
  scheduled.push_back({nextHandle, callback, data});
  everScheduled.push_back(scheduled.back());
  return nextHandle++;
}
void hdUnschedule(unsigned long handle) {
  const std::lock_guard lock(mutex);
  state.calls.push_back("hdUnschedule");
  std::erase_if(scheduled, [&](const Scheduled& one) { return one.handle == handle; });
}
}
