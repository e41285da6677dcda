#include "devices/vendor/phantom_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/device_options.h"
#include "base/error.h"
#include "devices/driver/drivers.h"

namespace reachlab::devices {

namespace {

// The scheduler is one for all devices of the program: started by the first, stopped by the last. Controlling thread only.
int schedulerUsers = 0;

std::string textOf(const hd::Api& hd, hd::Enum what) {
  const char* text = hd.getString != nullptr ? hd.getString(what) : nullptr;
  return text != nullptr ? text : "";
}

// A device is opened and closed while the scheduler stands still, as the vendor asks.
class SchedulerPause {
 public:
  explicit SchedulerPause(const hd::Api& hd) : hd_(hd) {
    if (schedulerUsers > 0) hd_.stopScheduler();
  }
  ~SchedulerPause() {
    if (schedulerUsers > 0) hd_.startScheduler();
  }
  SchedulerPause(const SchedulerPause&) = delete;
  SchedulerPause& operator=(const SchedulerPause&) = delete;

 private:
  const hd::Api& hd_;
};

// What of this program is open, with what it says of itself: asking the library again would refuse it, or take it from its user. Controlling
// thread only.
std::map<std::string, haptics::DeviceInfo>& openDevices() {
  static std::map<std::string, haptics::DeviceInfo> open;
  return open;
}

}  // namespace

PhantomDevice::PhantomDevice(const Options& options)
    : hd_(hd::api()), options_(options), words_("device phantom" + (options.name.empty() ? "" : ":" + options.name)) {
  open();
  try {
    readDescription();
    updateCalibration();
    frames_ = new PhantomFrames(hd_, {handle_, options_.deviceVelocity, options_.deadMan, info_.maxContinuousForce});
    if (!options_.drivesClock) schedule(nullptr, nullptr);
  } catch (...) {
    if (!everScheduled_) delete std::exchange(frames_, nullptr);
    closeDevice();
    throw;
  }
  openDevices()[options_.name] = info_;
}

void PhantomDevice::open() {
  const SchedulerPause pause(hd_);
  hd_.takeErrors();
  std::uint32_t code = hd::kSuccess;
  const hd::Handle handle = hd_.initDevice(options_.name.empty() ? nullptr : options_.name.c_str());
  const std::string error = hd_.takeErrors(&code);
  if (code != hd::kAlreadyInitiated) handle_ = handle;  // else it is somebody else's
  if (handle == hd::kNoHandle || !error.empty()) {
    closeDevice();
    refuse(error.empty() ? "hdInitDevice gave no device" : error);
  }
  hd_.makeCurrentDevice(handle_);
  for (const hd::Enum wish : {hd::kForceOutput, hd::kMaxForceClamping, hd::kForceRamping}) {
    hd_.enable(wish);
    if (const std::string said = hd_.takeErrors(); !said.empty() && wish == hd::kForceOutput) {
      closeDevice();
      refuse(said);
    }
  }
}

void PhantomDevice::closeDevice() noexcept {
  if (handle_ == hd::kNoHandle) return;
  const SchedulerPause pause(hd_);
  hd_.disableDevice(std::exchange(handle_, hd::kNoHandle));
  hd_.takeErrors();
}

void PhantomDevice::refuse(const std::string& what) { throw ResourceError(fmt::format("{}: {}: {}", words_, hd_.library.name(), what)); }

void PhantomDevice::readDescription() {
  const std::string model = textOf(hd_, hd::kModel), serial = textOf(hd_, hd::kSerial);
  hd_.takeErrors();  // a name that it does not tell is no reason against it
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
  info_.rendersForce = true;
  info_.drivesClock = options_.drivesClock;
  if (options_.deadMan && hd_.getBooleanv == nullptr)
    refuse("it does not tell its safety switch (hdGetBooleanv), which dead-man=yes asks for");
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
  openDevices().erase(options_.name);
  closeDevice();
  if (!everScheduled_) delete frames_;
}

std::string PhantomDevice::healthText() const {
  const std::uint32_t code = frames_->lastError();
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
  frames_->noteForceOff();
  hd_.makeCurrentDevice(handle_);
  hd_.disable(hd::kForceOutput);
  return true;
}

void PhantomDevice::startClock(ClockTick tick, void* context) {
  if (!scheduled_) schedule(tick, context);
}

void PhantomDevice::schedule(ClockTick tick, void* context) {
  if (everScheduled_) frames_ = new PhantomFrames(hd_, {handle_, options_.deviceVelocity, options_.deadMan, info_.maxContinuousForce});
  frames_->setTick(tick, context);
  frames_->enlist();
  everScheduled_ = true;
  hd_.makeCurrentDevice(handle_);
  callback_ = hd_.scheduleAsynchronous([](void* frames) -> std::uint32_t { return static_cast<PhantomFrames*>(frames)->call(); }, frames_,
                                       hd::kHighestPriority);
  if (const std::string error = hd_.takeErrors(); !error.empty()) {
    frames_->retire();
    refuse("no callback: " + error);
  }
  scheduled_ = true;
  if (schedulerUsers++ > 0) return;
  if (hd_.setSchedulerRate != nullptr) {
    hd_.setSchedulerRate(1000);
    hd_.takeErrors();  // an older device keeps its own rate, which is then counted as missed ticks
  }
  hd_.startScheduler();
  if (const std::string error = hd_.takeErrors(); !error.empty()) {
    stopClock();
    refuse("its scheduler does not start: " + error);
  }
}

// A frame with zero force, then no more frames.
void PhantomDevice::stopClock() noexcept {
  if (!std::exchange(scheduled_, false)) return;
  frames_->stop();
  if (--schedulerUsers == 0) hd_.stopScheduler();
  hd_.unschedule(callback_);
  frames_->retire();
  hd_.takeErrors();
}

namespace {

std::unique_ptr<haptics::HapticDevice> makePhantom(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  PhantomDevice::Options chosen;
  chosen.name = options.plain();
  chosen.deviceVelocity = options.word("velocity", {"estimated", "device"}) == "device";
  chosen.deadMan = options.word("dead-man", {"no", "yes"}) == "yes";
  chosen.drivesClock = options.word("clock", {"device", "computer"}) == "device";
  options.done();
  return std::make_unique<PhantomDevice>(chosen);
}

std::vector<FoundDevice> findPhantom(const DeviceDriver& self) {
  std::vector<FoundDevice> inUse;
  for (const auto& [name, info] : openDevices()) inUse.push_back(presentDevice(self, name, info));
  if (!inUse.empty()) return inUse;
  try {
    return {presentDevice(self, {}, PhantomDevice({}).info())};
  } catch (const ResourceError& error) {
    return {absentDevice(self, error.what())};
  }
}

}  // namespace

DeviceDriver phantomDriver() {
  return {"phantom", "phantom[:NAME][,clock=computer]",
          "PHANToM and Touch by the vendor's OpenHaptics (libHD.so); NAME as in its configuration", findPhantom, makePhantom};
}

}  // namespace reachlab::devices
