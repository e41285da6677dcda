#include "devices/io/polled_device.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/system/os.h"

namespace reachlab::devices {

using haptics::DeviceHealth;
using haptics::DeviceSample;

namespace {

constexpr std::int64_t kPauseNs = 1'000'000;  // after an exchange that brought nothing, so that a dead device does not burn a core
constexpr std::int64_t kGuardNs = 5'000'000;  // how often the guard looks
constexpr std::chrono::milliseconds kPatience{300};

}  // namespace

struct PolledDevice::Shared final : ForceSource {
  struct TimedForce {
    Vec3 force;           // [N]
    std::int64_t ns = 0;  // when the tick left it
  };

  Shared(std::shared_ptr<Transport> t, std::int64_t (*n)()) : transport(std::move(t)), clock(n) {}

  std::shared_ptr<Transport> transport;
  std::int64_t (*clock)();
  TripleBuffer<TimedForce> forces;     // tick -> I/O
  TripleBuffer<DeviceSample> samples;  // I/O -> tick
  std::atomic<bool> stopping{false}, lost{false}, forceStopped{false};
  std::atomic<std::int64_t> exchangeSinceNs{0};  // when the exchange under way began; 0: none is
  std::atomic<std::uint64_t> reports{0};
  // Between the controlling thread and the I/O thread only.
  std::promise<void> firstReport;
  std::mutex mutex;
  std::optional<std::promise<std::string>> calibration;  // asked for and not done: its fault, or an empty text
  std::string loss;                                      // the transport's words
  TimedForce latest;                                     // the I/O thread's

  std::int64_t nextReopenNs = 0;  // the I/O thread's
  bool zeroTold = false;          // the I/O thread's, since the device was lost
  DeviceSample sample;            // the I/O thread's

  Vec3 newest() noexcept override;
  std::int64_t now() const noexcept override { return clock(); }
  void run();
  void guard();
  bool turn();
  bool reopened();
  void serveCalibration();
  void takeReport();
};

void PolledDevice::Shared::takeReport() {
  sample.valid = true;
  sample.reports = reports.load(std::memory_order_relaxed) + 1;
  sample.takenNs = now();
  samples.publish(sample);
  lost.store(false, std::memory_order_release);
  reports.store(sample.reports, std::memory_order_release);
  if (sample.reports == 1) firstReport.set_value();
}

void PolledDevice::Shared::serveCalibration() {
  std::optional<std::promise<std::string>> asked;
  {
    const std::lock_guard lock(mutex);
    asked = std::exchange(calibration, std::nullopt);
  }
  if (asked) asked->set_value(transport->calibrate());
}

Vec3 PolledDevice::Shared::newest() noexcept {
  if (const TimedForce* force = forces.takeLatest()) latest = *force;
  const bool off = now() - latest.ns > kStaleNs || forceStopped.load(std::memory_order_acquire) || lost.load(std::memory_order_acquire) ||
                   stopping.load(std::memory_order_acquire);
  return off ? Vec3{} : latest.force;
}

bool PolledDevice::Shared::reopened() {
  try {
    return transport->reopen();
  } catch (const ResourceError&) {
    return false;
  }
}

// False: it brought nothing, and there is no hurry.
bool PolledDevice::Shared::turn() {
  serveCalibration();
  if (lost.load(std::memory_order_acquire)) {
    if (!zeroTold) zeroTold = transport->tellZero();
    if (now() < nextReopenNs) return false;
    nextReopenNs = now() + kReopenNs;
    if (!reopened()) return false;
  }
  exchangeSinceNs.store(now(), std::memory_order_release);
  const Exchange exchanged = transport->exchange(*this, sample);
  exchangeSinceNs.store(0, std::memory_order_release);
  switch (exchanged) {
    case Exchange::Report: takeReport(); return true;
    case Exchange::Nothing: return false;
    case Exchange::Lost: break;
  }
  {
    const std::string why = transport->lossText();
    const std::lock_guard lock(mutex);
    loss = why;
  }
  zeroTold = transport->tellZero();
  lost.store(true, std::memory_order_release);
  nextReopenNs = now() + kReopenNs;
  return false;
}

void PolledDevice::Shared::run() {
  const std::int64_t period = transport->period();
  std::int64_t next = now();
  while (!stopping.load(std::memory_order_acquire)) {
    if (period > 0) {
      os::sleepUntil(next);
      next = std::max(next + period, now());
    }
    if (!turn() && period == 0) os::sleepUntil(now() + kPauseNs);
  }
  transport->close();
}

// Once for each exchange that hangs.
void PolledDevice::Shared::guard() {
  std::int64_t told = 0;
  while (!stopping.load(std::memory_order_acquire)) {
    const std::int64_t since = exchangeSinceNs.load(std::memory_order_acquire);
    if (since != 0 && since != told && now() - since > kStaleNs) {
      told = since;
      transport->stopForce();
    }
    os::sleepUntil(now() + kGuardNs);
  }
}

PolledDevice::PolledDevice(std::shared_ptr<Transport> transport, int patienceMs)
    : info_(transport->info()), shared_(std::make_shared<Shared>(std::move(transport), os::now)) {
  thread_ = haptics::LeavableThread([shared = shared_] {
    constexpr int kBelowTheTick = 70;
    os::requestRealTime(kBelowTheTick);
    os::requestExactSleep();
    shared->run();
  });
  if (info_.rendersForce)
    guard_ = haptics::LeavableThread([shared = shared_] {
      os::requestExactSleep();
      shared->guard();
    });
  if (shared_->firstReport.get_future().wait_for(std::chrono::milliseconds(patienceMs)) == std::future_status::ready) return;
  shared_->stopping = true;
  std::string why;
  if (thread_.join(kPatience)) why = shared_->transport->lossText();
  else thread_.leave();
  throw ResourceError(
      fmt::format("{}: it was opened, but no report came within {} ms{}{}", info_.name, patienceMs, why.empty() ? "" : ": ", why));
}

PolledDevice::PolledDevice(std::shared_ptr<Transport> transport, std::int64_t (*now)())
    : info_(transport->info()), shared_(std::make_shared<Shared>(std::move(transport), now)) {}

PolledDevice::~PolledDevice() {
  shared_->stopping = true;
  if (!thread_.running()) {
    shared_->transport->close();
    return;
  }
  if (!thread_.join(kPatience)) thread_.leave();
  if (!guard_.join(kPatience)) guard_.leave();
}

void PolledDevice::step() { shared_->turn(); }

DeviceSample PolledDevice::read() noexcept {
  if (const DeviceSample* newest = shared_->samples.takeLatest()) last_ = *newest;
  DeviceSample sample = last_;
  if (shared_->lost.load(std::memory_order_acquire)) sample.valid = false;
  return sample;
}

void PolledDevice::write(const Vec3& force) noexcept {
  shared_->forceStopped.store(false, std::memory_order_release);
  shared_->forces.publish({force, shared_->now()});
}

DeviceHealth PolledDevice::health() const noexcept {
  return shared_->lost.load(std::memory_order_acquire) ? DeviceHealth::Lost : DeviceHealth::Ready;
}

std::string PolledDevice::healthText() const {
  if (health() != DeviceHealth::Lost) return {};
  const std::lock_guard lock(shared_->mutex);
  return shared_->loss.empty() ? "no connection any more" : shared_->loss;
}

bool PolledDevice::stopForce() noexcept {
  shared_->forceStopped.store(true, std::memory_order_release);
  return true;
}

std::string PolledDevice::describeStale() {
  return fmt::format("the I/O thread tells it zero when the tick leaves no new force for {} ms", kStaleNs / 1'000'000);
}
std::string PolledDevice::calibrationHint() const { return shared_->transport->calibrationHint(); }

void PolledDevice::calibrate() {
  std::future<std::string> answer;
  {
    const std::lock_guard lock(shared_->mutex);
    answer = shared_->calibration.emplace().get_future();
  }
  if (answer.wait_for(std::chrono::seconds(5)) != std::future_status::ready)
    throw ResourceError(fmt::format("device {}: it did not answer the calibration within 5 s", info_.name));
  if (const std::string fault = answer.get(); !fault.empty()) throw ResourceError(fmt::format("device {}: {}", info_.name, fault));
}

}  // namespace reachlab::devices
