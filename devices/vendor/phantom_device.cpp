#include "devices/vendor/phantom_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "base/os.h"
#include "devices/drivers.h"
#include "devices/options.h"
#include "devices/orientation.h"

namespace reachlab::devices {

using haptics::DeviceHealth;

namespace {

constexpr double kMetresPerMm = 1e-3;

// The scheduler is one for all devices of the program: started by the first, stopped by the last. Controlling thread only.
int schedulerUsers = 0;

std::string textOf(const hd::Api& hd, hd::Enum what) {
  const char* text = hd.getString != nullptr ? hd.getString(what) : nullptr;
  return text != nullptr ? text : "";
}

}  // namespace

PhantomDevice::PhantomDevice(const Options& options)
    : hd_(hd::api()), options_(options), words_("device phantom" + (options.name.empty() ? "" : ":" + options.name)) {
  hd_.takeErrors();
  handle_ = hd_.initDevice(options_.name.empty() ? nullptr : options_.name.c_str());
  const std::string error = hd_.takeErrors();
  if (handle_ == hd::kNoHandle || !error.empty()) refuse(error.empty() ? "hdInitDevice gave no device" : error);
  hd_.makeCurrentDevice(handle_);
  for (const hd::Enum wish : {hd::kForceOutput, hd::kMaxForceClamping, hd::kForceRamping}) {
    hd_.enable(wish);
    if (const std::string said = hd_.takeErrors(); !said.empty() && wish == hd::kForceOutput) refuse(said);
  }
  readDescription();
  updateCalibration();
}

void PhantomDevice::refuse(const std::string& what) {
  if (handle_ != hd::kNoHandle) hd_.disableDevice(handle_);
  handle_ = hd::kNoHandle;
  throw ResourceError(fmt::format("{}: {}: {}", words_, hd_.library.name(), what));
}

void PhantomDevice::readDescription() {
  const std::string model = textOf(hd_, hd::kModel), serial = textOf(hd_, hd::kSerial);
  info_.name = model.empty() ? "PHANToM" : model + (serial.empty() ? "" : " " + serial);
  info_.version = "OpenHaptics, " + hd_.library.name();
  const auto numberOf = [&](hd::Enum what) {
    double value = 0;
    hd_.getDoublev(what, &value);
    return hd_.takeErrors().empty() && std::isfinite(value) ? value : 0.0;
  };
  const double peak = numberOf(hd::kMaxForce);
  if (!(peak > 0)) refuse("it does not tell its largest force (HD_NOMINAL_MAX_FORCE), and is not driven without");
  info_.maxForce = peak;
  info_.maxContinuousForce = std::max(0.0, numberOf(hd::kMaxContinuousForce));
  std::array<double, 6> workspace{};
  hd_.getDoublev(hd::kUsableWorkspace, workspace.data());
  if (hd_.takeErrors().empty()) {
    double radius = std::abs(workspace[0]);
    for (const double edge : workspace) radius = std::min(radius, std::abs(edge));
    info_.workspaceRadius = radius * kMetresPerMm;
  }
  info_.rendersForce = info_.drivesClock = true;
  info_.secondPath = "hdDisable(HD_FORCE_OUTPUT) from the watchdog's thread";
}

// What can be done without the user's hands is done; what cannot is said.
void PhantomDevice::updateCalibration() {
  if (hd_.checkCalibration == nullptr) return;
  hd::Enum state = hd_.checkCalibration();
  hd_.takeErrors();
  if (state == hd::kCalibrationNeedsUpdate && hd_.updateCalibration != nullptr) {
    const hd::Enum styles = hd_.checkCalibrationStyle != nullptr ? hd_.checkCalibrationStyle() : hd::kAutomatic;
    hd_.updateCalibration(styles & hd::kAutomatic ? hd::kAutomatic : styles & hd::kInkwell ? hd::kInkwell : hd::kEncoderReset);
    const std::string said = hd_.takeErrors();
    state = hd_.checkCalibration();
    if (!said.empty()) refuse("calibration: " + said);
  }
  if (state == hd::kCalibrationNeedsInput || state == hd::kCalibrationNeedsUpdate)
    refuse("it is not calibrated: put the stylus into the inkwell (or the arm into its neutral place) and start again");
}

PhantomDevice::~PhantomDevice() {
  stopClock();
  if (handle_ != hd::kNoHandle) hd_.disableDevice(handle_);
}

std::string PhantomDevice::healthText() const {
  const std::uint32_t code = lastError_.load(std::memory_order_acquire);
  if (code == hd::kSuccess) return {};
  const char* said = hd_.getErrorString(code);
  return fmt::format("{} (0x{:04X})", said != nullptr ? said : "", code);
}

std::string PhantomDevice::calibrationHint() const { return "put the stylus into the inkwell, or hold the arm in its neutral place"; }

void PhantomDevice::calibrate() {
  hd_.makeCurrentDevice(handle_);
  updateCalibration();
}

bool PhantomDevice::stopForce() noexcept {
  forceOff_.store(true, std::memory_order_release);
  hd_.makeCurrentDevice(handle_);
  hd_.disable(hd::kForceOutput);
  return true;
}

void PhantomDevice::startClock(ClockTick tick, void* context) {
  tick_ = tick;
  context_ = context;
  stopping_ = false;
  hd_.makeCurrentDevice(handle_);
  callback_ = hd_.scheduleAsynchronous([](void* self) -> std::uint32_t { return static_cast<PhantomDevice*>(self)->frame(); }, this,
                                       hd::kHighestPriority);
  if (const std::string error = hd_.takeErrors(); !error.empty()) throw ResourceError(words_ + ": no callback: " + error);
  scheduled_ = true;
  if (schedulerUsers++ > 0) return;
  if (hd_.setSchedulerRate != nullptr) {
    hd_.setSchedulerRate(1000);
    hd_.takeErrors();  // an older device keeps its own rate, which is then counted as missed ticks
  }
  hd_.startScheduler();
  if (const std::string error = hd_.takeErrors(); !error.empty()) {
    stopClock();
    throw ResourceError(words_ + ": its scheduler does not start: " + error);
  }
}

// A frame with zero force, then no more frames. Bounded: a scheduler that does not call any more is not waited for.
void PhantomDevice::stopClock() noexcept {
  if (!scheduled_) return;
  scheduled_ = false;
  zeroFrames_ = 0;
  stopping_.store(true, std::memory_order_release);
  constexpr int kMostWaits = 50;
  constexpr std::int64_t kWaitNs = 2'000'000;
  for (int i = 0; i < kMostWaits && zeroFrames_.load(std::memory_order_acquire) < 2; ++i) os::sleepUntil(os::now() + kWaitNs);
  if (--schedulerUsers == 0) hd_.stopScheduler();
  hd_.unschedule(callback_);
  hd_.takeErrors();
}

void PhantomDevice::readFrame() noexcept {
  // A call that fails leaves what it was given: the place of before, and not the origin.
  const Vec3 before = sample_.position / kMetresPerMm;
  std::array<double, 3> mm{before.x, before.y, before.z}, speed{};
  std::array<double, 16> transform{};
  std::int32_t buttons = 0;
  hd_.getDoublev(hd::kPosition, mm.data());
  hd_.getIntegerv(hd::kButtons, &buttons);
  if (readsTransform_) hd_.getDoublev(hd::kTransform, transform.data());
  sample_.position = kMetresPerMm * Vec3{mm[0], mm[1], mm[2]};
  sample_.buttons = static_cast<std::uint32_t>(buttons);
  if (options_.deviceVelocity) {
    hd_.getDoublev(hd::kVelocity, speed.data());
    sample_.velocity = kMetresPerMm * Vec3{speed[0], speed[1], speed[2]};
    sample_.hasVelocity = true;
  }
  if (options_.deadMan && hd_.getBooleanv != nullptr) {
    std::uint8_t closed = 1;
    hd_.getBooleanv(hd::kSafetySwitch, &closed);
    sample_.released = closed == 0;
  }
  if (const auto q = quaternionOf({{{transform[0], transform[4], transform[8]},
                                    {transform[1], transform[5], transform[9]},
                                    {transform[2], transform[6], transform[10]}}})) {
    sample_.orientation = *q;
    sample_.hasOrientation = true;
  }
  ++sample_.reports;
  sample_.takenNs = os::now();
}

void PhantomDevice::writeFrame() noexcept {
  Vec3 force = stopping_.load(std::memory_order_acquire) ? Vec3{} : force_;
  const DeviceHealth health = health_.load(std::memory_order_relaxed);
  if (health == DeviceHealth::Lost || health == DeviceHealth::Failed || !isFinite(force)) force = {};
  if (const double size = norm(force); health == DeviceHealth::Warm && info_.maxContinuousForce > 0 && size > info_.maxContinuousForce)
    force = info_.maxContinuousForce / size * force;
  if (norm(force) > 0 && forceOff_.exchange(false, std::memory_order_acq_rel)) hd_.enable(hd::kForceOutput);
  const std::array<double, 3> newtons{force.x, force.y, force.z};
  hd_.setDoublev(hd::kForce, newtons.data());
}

void PhantomDevice::takeFrameErrors() noexcept {
  constexpr int kMost = 16, kCoolFrames = 1000;
  ++goodFrames_;
  for (int i = 0; i < kMost; ++i) {
    const hd::ErrorInfo error = hd_.getError();
    if (error.code == hd::kSuccess) break;
    goodFrames_ = 0;
    lastError_.store(error.code, std::memory_order_release);
    DeviceHealth health = health_.load(std::memory_order_relaxed);
    if (error.code == hd::kWarmMotors) health = health == DeviceHealth::Ready ? DeviceHealth::Warm : health;
    else if (error.code >= hd::kFirstArgumentError && error.code <= hd::kLastArgumentError && readsTransform_)
      readsTransform_ = false;  // the one thing asked for that a device may not know
    else if (error.code >= hd::kDeviceFault && error.code <= hd::kTimer) health = DeviceHealth::Lost;
    else if (health != DeviceHealth::Lost) health = DeviceHealth::Failed;
    health_.store(health, std::memory_order_release);
  }
  if (goodFrames_ > kCoolFrames && health_.load(std::memory_order_relaxed) == DeviceHealth::Warm)
    health_.store(DeviceHealth::Ready, std::memory_order_release);
  if (health_.load(std::memory_order_relaxed) == DeviceHealth::Lost) sample_.valid = false;
}

std::uint32_t PhantomDevice::frame() noexcept {
  hd_.beginFrame(handle_);
  readFrame();
  takeFrameErrors();
  if (!stopping_.load(std::memory_order_acquire)) tick_(context_);
  writeFrame();
  hd_.endFrame(handle_);
  takeFrameErrors();
  if (stopping_.load(std::memory_order_acquire)) zeroFrames_.fetch_add(1, std::memory_order_acq_rel);
  return hd::kCallbackContinue;
}

namespace {

std::unique_ptr<haptics::HapticDevice> makePhantom(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  PhantomDevice::Options chosen;
  chosen.name = options.plain();
  chosen.deviceVelocity = options.word("velocity", {"estimated", "device"}) == "device";
  chosen.deadMan = options.word("dead-man", {"no", "yes"}) == "yes";
  options.done();
  return std::make_unique<PhantomDevice>(chosen);
}

std::vector<FoundDevice> findPhantom(const DeviceDriver& self) {
  try {
    return {presentDevice(self, self.name, PhantomDevice({}).info())};
  } catch (const ResourceError& error) {
    return {absentDevice(self, error.what())};
  }
}

}  // namespace

DeviceDriver phantomDriver() {
  return {"phantom", "phantom[:NAME]", "PHANToM and Touch by the vendor's OpenHaptics (libHD.so); NAME as in its configuration",
          false,     findPhantom,      makePhantom};
}

}  // namespace reachlab::devices
