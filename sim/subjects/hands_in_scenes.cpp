#include "sim/subjects/hands_in_scenes.h"

#include <atomic>
#include <utility>

namespace reachlab::subjects {
namespace {

class HandsInScenes final : public haptics::HapticDevice {
 public:
  explicit HandsInScenes(std::vector<std::unique_ptr<haptics::HapticDevice>> hands)
      : hands_(std::move(hands)), now_(hands_.front().get()) {}

  haptics::DeviceInfo info() const override { return hands_.front()->info(); }
  void prepareTrial(int index, int scene = 0) override {
    haptics::HapticDevice* next = hands_.at(static_cast<std::size_t>(scene)).get();
    haptics::HapticDevice* before = std::exchange(prepared_, next);
    if (before != nullptr && before != next) before->prepareTrial(index, scene);
    next->prepareTrial(index, scene);
    next_.store(next, std::memory_order_release);
  }
  void cue(haptics::Cue cue) noexcept override {
    if (cue == haptics::Cue::Place)
      if (haptics::HapticDevice* next = next_.load(std::memory_order_acquire)) now_ = next;
    now_->cue(cue);
  }
  haptics::DeviceSample read() noexcept override { return now_->read(); }
  void write(const Vec3& force) noexcept override { now_->write(force); }
  void see(std::span<const dynamics::MassState> masses) noexcept override { now_->see(masses); }
  bool stopForce() noexcept override {
    bool stopped = true;
    for (const auto& hand : hands_) stopped = hand->stopForce() && stopped;
    return stopped;
  }

 private:
  std::vector<std::unique_ptr<haptics::HapticDevice>> hands_;
  haptics::HapticDevice* prepared_ = nullptr;          // the controlling thread's
  std::atomic<haptics::HapticDevice*> next_{nullptr};  // taken over at Cue::Place
  haptics::HapticDevice* now_;                         // the haptic thread's
};

}  // namespace

std::unique_ptr<haptics::HapticDevice> joinScenes(std::vector<std::unique_ptr<haptics::HapticDevice>> hands) {
  return std::make_unique<HandsInScenes>(std::move(hands));
}

}  // namespace reachlab::subjects
