#include "devices/io/rate_hand.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/ticks.h"

namespace reachlab::devices {
namespace {

double shaped(double push, double deadZone) noexcept {
  const double beyond = std::abs(push) - deadZone;
  return beyond > 0 ? std::copysign(std::min(beyond / (1 - deadZone), 1.0), push) : 0;
}

}  // namespace

RateHand::RateHand(haptics::DeviceInfo info, const Options& options, const Vec3& start, std::shared_ptr<DeflectionSource> source)
    : info_(std::move(info)), options_(options), start_(start), shared_(std::make_shared<Shared>()) {
  sample_.position = start;
  sample_.hasVelocity = true;
  thread_ = haptics::LeavableThread([shared = shared_, source = std::move(source)] {
    while (!shared->stopping.load(std::memory_order_acquire)) {
      Deflection newest;
      bool lost = false;
      const bool came = source->wait(newest, lost);
      shared->lost.store(lost, std::memory_order_release);
      if (came && isFinite(newest.push)) shared->deflections.publish(newest);
    }
  });
}

RateHand::~RateHand() {
  shared_->stopping = true;
  if (!thread_.join(std::chrono::milliseconds(500))) thread_.leave();
}

void RateHand::cue(haptics::Cue cue) noexcept {
  if (cue == haptics::Cue::Place) sample_.position = start_;
}

haptics::DeviceSample RateHand::read() noexcept {
  ++age_;
  if (const Deflection* newest = shared_->deflections.takeLatest()) {
    deflection_ = *newest;
    age_ = 0;
    ++sample_.reports;
  }
  const double held = age_ <= kHoldTicks ? 1 : std::exp(-static_cast<double>(age_ - kHoldTicks) / kFadeTicks);
  const auto speed = [&](double push) { return options_.gain * held * shaped(push, options_.deadZone); };
  sample_.velocity = {speed(deflection_.push.x), speed(deflection_.push.y), speed(deflection_.push.z)};
  const Vec3 next = sample_.position + kTickSeconds * sample_.velocity;
  const auto within = [&](double at, double middle) { return std::clamp(at, middle - options_.reach, middle + options_.reach); };
  const Vec3 bounded{within(next.x, start_.x), within(next.y, start_.y), within(next.z, start_.z)};
  if (!(bounded == next)) sample_.velocity = (bounded - sample_.position) / kTickSeconds;
  sample_.position = bounded;
  sample_.buttons = deflection_.buttons;
  sample_.valid = !shared_->lost.load(std::memory_order_acquire);
  return sample_;
}

haptics::DeviceHealth RateHand::health() const noexcept {
  return shared_->lost.load(std::memory_order_acquire) ? haptics::DeviceHealth::Lost : haptics::DeviceHealth::Ready;
}

}  // namespace reachlab::devices
