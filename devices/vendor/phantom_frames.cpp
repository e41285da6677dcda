#include "devices/vendor/phantom_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "base/system/os.h"

namespace reachlab::devices {

using haptics::DeviceHealth;

namespace {

constexpr std::int64_t kSchedulerPeriodNs = 1'000'000;
constexpr std::int64_t kStaleNs = 20'000'000;  // a force that the tick has not renewed for so long is none

// Every device whose frames are scheduled. The library keeps one stack of errors for all of them; each error names its device.
std::array<std::atomic<PhantomFrames*>, 16> enlisted{};
std::array<std::atomic<hd::Handle>, enlisted.size()> handles{};

}  // namespace

void PhantomFrames::setTick(haptics::HapticDevice::ClockTick tick, void* context) noexcept {
  tick_ = tick;
  context_ = context;
}

void PhantomFrames::enlist() noexcept {
  for (std::size_t i = 0; i < enlisted.size(); ++i) {
    if (enlisted[i].load(std::memory_order_acquire) != nullptr) continue;
    handles[i].store(settings_.handle, std::memory_order_relaxed);
    enlisted[i].store(this, std::memory_order_release);
    return;
  }
}

void PhantomFrames::retire() noexcept {
  retired_.store(true, std::memory_order_release);
  for (auto& place : enlisted) {
    PhantomFrames* self = this;
    place.compare_exchange_strong(self, nullptr, std::memory_order_acq_rel);
  }
}

void PhantomFrames::stop() noexcept {
  constexpr int kMostWaits = 50;
  constexpr std::int64_t kWaitNs = 2'000'000;
  zeroFrames_ = 0;
  stopping_ = true;
  for (int i = 0; i < kMostWaits && zeroFrames_ < 2; ++i) os::sleepUntil(os::now() + kWaitNs);
  while (inTick_) std::this_thread::yield();  // a tick waits for nothing, so it ends
}

haptics::DeviceSample PhantomFrames::read() noexcept {
  if (tick_ != nullptr) taken_ = sample_;
  else if (const haptics::DeviceSample* newest = samples_.takeLatest()) taken_ = *newest;
  return taken_;
}

void PhantomFrames::write(const Vec3& force) noexcept {
  const std::int64_t now = os::now();
  if (lastTickNs_ != 0) times_.jitter.add(std::abs(now - lastTickNs_ - kSchedulerPeriodNs));
  lastTickNs_ = now;
  const Left left{force, now, taken_.takenNs};
  if (tick_ != nullptr) left_ = left, isNew_ = true;
  else forces_.publish(left);
}

void PhantomFrames::readFrame() noexcept {
  // A call that fails leaves what it was given: the place of before, and not the origin.
  const Vec3 before = sample_.position / kMetresPerMm;
  std::array<double, 3> mm{before.x, before.y, before.z}, speed{};
  std::int32_t buttons = 0;
  hd_.getDoublev(hd::kPosition, mm.data());
  hd_.getIntegerv(hd::kButtons, &buttons);
  sample_.position = kMetresPerMm * Vec3{mm[0], mm[1], mm[2]};
  sample_.buttons = static_cast<std::uint32_t>(buttons);
  if (settings_.deviceVelocity) {
    hd_.getDoublev(hd::kVelocity, speed.data());
    sample_.velocity = kMetresPerMm * Vec3{speed[0], speed[1], speed[2]};
    sample_.hasVelocity = true;
  }
  if (settings_.deadMan && hd_.getBooleanv != nullptr) {
    std::uint8_t closed = 1;
    hd_.getBooleanv(hd::kSafetySwitch, &closed);
    sample_.released = closed == 0;
  }
  ++sample_.reports;
  sample_.takenNs = os::now();
}

void PhantomFrames::writeFrame() noexcept {
  if (const Left* newer = tick_ == nullptr ? forces_.takeLatest() : nullptr) left_ = *newer, isNew_ = true;
  const bool stale = os::now() - left_.leftNs > kStaleNs;
  Vec3 force = stopping_ || stale ? Vec3{} : left_.force;
  const DeviceHealth health = health_.load(std::memory_order_relaxed);
  if (health == DeviceHealth::Lost || health == DeviceHealth::Failed || !isFinite(force)) force = {};
  if (const double size = norm(force); health == DeviceHealth::Warm && settings_.continuousForce > 0 && size > settings_.continuousForce)
    force = settings_.continuousForce / size * force;
  if (norm(force) > 0 && forceOff_.exchange(false, std::memory_order_acq_rel)) hd_.enable(hd::kForceOutput);
  const std::array<double, 3> newtons{force.x, force.y, force.z};
  hd_.setDoublev(hd::kForce, newtons.data());
}

void PhantomFrames::judge(std::uint32_t code) noexcept {
  goodFrames_ = 0;
  lastError_.store(code, std::memory_order_release);
  DeviceHealth health = health_.load(std::memory_order_relaxed);
  if (code == hd::kWarmMotors) health = health == DeviceHealth::Ready ? DeviceHealth::Warm : health;
  else if (code >= hd::kDeviceFault && code <= hd::kTimer) health = DeviceHealth::Lost;
  else if (health != DeviceHealth::Lost) {
    health = DeviceHealth::Failed;
    noteForceOff();  // by its own software
  }
  health_.store(health, std::memory_order_release);
}

void PhantomFrames::takeErrors() noexcept {
  constexpr int kMost = 16, kGoodFrames = 1000;
  if (const std::uint32_t code = told_.exchange(0, std::memory_order_acq_rel); code != 0) judge(code);
  for (int i = 0; i < kMost; ++i) {
    const hd::ErrorInfo error = hd_.getError();
    if (error.code == hd::kSuccess) break;
    PhantomFrames* of = this;
    for (std::size_t k = 0; k < enlisted.size() && error.device != settings_.handle; ++k)
      if (PhantomFrames* other = enlisted[k].load(std::memory_order_acquire); other != nullptr && handles[k] == error.device) of = other;
    if (of == this) judge(error.code);
    else of->told_.store(error.code, std::memory_order_release);
  }
  const DeviceHealth health = health_.load(std::memory_order_relaxed);
  if (goodFrames_ > kGoodFrames && (health == DeviceHealth::Warm || health == DeviceHealth::Failed))
    health_.store(DeviceHealth::Ready, std::memory_order_release);
  if (health == DeviceHealth::Lost) sample_.valid = false;
}

std::uint32_t PhantomFrames::call() noexcept {
  if (retired_.load(std::memory_order_acquire)) return hd::kCallbackDone;
  hd_.makeCurrentDevice(settings_.handle);  // with two devices it is the other one's, and not every library's frame makes it current
  hd_.beginFrame(settings_.handle);
  ++goodFrames_;
  readFrame();
  takeErrors();
  if (tick_ != nullptr) {
    inTick_ = true;
    if (!stopping_) tick_(context_);
    inTick_ = false;
  } else {
    samples_.publish(sample_);
  }
  writeFrame();
  hd_.endFrame(settings_.handle);
  if (std::exchange(isNew_, false) && left_.sampleNs != 0) times_.age.add(os::now() - left_.sampleNs);
  takeErrors();
  if (stopping_) zeroFrames_.fetch_add(1, std::memory_order_acq_rel);
  return hd::kCallbackContinue;
}

}  // namespace reachlab::devices
