#include "devices/input/input_hands.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>

#include "base/error.h"
#include "base/system/os.h"
#include "devices/driver/drivers.h"
#include "devices/driver/options.h"

namespace reachlab::devices {
namespace {

constexpr int kRepeatMs = 8;  // a held key is news as long as it is held
constexpr std::int64_t kReopenNs = 200'000'000;

/// Reads events, and opens the node again after it was lost.
class InputReader {
 public:
  InputReader(const InputNode& node, OpenInput open) : state_(node), node_(node), open_(std::move(open)), port_(open_()) {}

  /// Calls `each` at the end of every report that came within kRepeatMs. False: it is gone.
  template <typename Each>
  bool read(Each&& each) {
    if (!port_ && !reopen()) return false;
    std::array<input_event, 64> events{};
    const int got = port_->read(events, kRepeatMs);
    if (got < 0) {
      port_.reset();
      state_ = InputState(node_);  // nothing is held by a device that is gone
      return false;
    }
    for (int i = 0; i < got; ++i) {
      const input_event& event = events[static_cast<std::size_t>(i)];
      if (state_.take(event)) each(event.input_event_sec * 1'000'000'000 + event.input_event_usec * 1000);
    }
    return true;
  }
  const InputState& state() const { return state_; }

 private:
  bool reopen() {
    os::sleepUntil(os::now() + kReopenNs);
    try {
      port_ = open_();
      return true;
    } catch (const ResourceError&) {
      return false;
    }
  }
  InputState state_;
  InputNode node_;
  OpenInput open_;
  std::unique_ptr<InputPort> port_;
};

class InputSource final : public DeflectionSource {
 public:
  InputSource(const InputNode& node, OpenInput open) : reader_(node, std::move(open)) {}
  bool wait(Deflection& newest, bool& lost) override {
    lost = !reader_.read([](std::int64_t) {});
    newest = reader_.state().deflection();
    return !lost;
  }

 private:
  InputReader reader_;
};

class TabletHand final : public haptics::HapticDevice {
 public:
  TabletHand(const InputNode& node, double halfWidth, const Vec3& start, OpenInput open)
      : name_(node.name), shared_(std::make_shared<Shared>(start)) {
    auto reader = std::make_shared<InputReader>(node, std::move(open));
    thread_ = haptics::LeavableThread([shared = shared_, reader, halfWidth, middle = Vec3{0, 0, start.z}] {
      while (!shared->stopping.load(std::memory_order_acquire)) {
        const bool there = reader->read([&](std::int64_t ns) {
          double x = 0, y = 0;
          if (reader->state().pen(x, y)) shared->hand.point(middle + halfWidth * Vec3{x, y, 0}, ns);
        });
        shared->buttons.store(reader->state().buttons(), std::memory_order_relaxed);
        shared->lost.store(!there, std::memory_order_release);
      }
    });
  }
  ~TabletHand() override {
    shared_->stopping = true;
    if (!thread_.join(std::chrono::milliseconds(500))) thread_.leave();
  }
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info;
    info.name = name_.empty() ? "tablet" : name_;
    info.version = "evdev";
    info.degreesOfFreedom = 2;
    info.rate = 200;
    return info;
  }
  haptics::DeviceSample read() noexcept override {
    haptics::DeviceSample sample = shared_->hand.read();
    sample.buttons = shared_->buttons.load(std::memory_order_relaxed);
    sample.valid = !shared_->lost.load(std::memory_order_acquire);
    return sample;
  }
  void write(const Vec3&) noexcept override {}
  haptics::DeviceHealth health() const noexcept override {
    return shared_->lost.load(std::memory_order_acquire) ? haptics::DeviceHealth::Lost : haptics::DeviceHealth::Ready;
  }

 private:
  struct Shared {
    explicit Shared(const Vec3& at) : hand(at) {}
    MouseDevice hand;
    std::atomic<bool> stopping{false}, lost{false};
    std::atomic<std::uint32_t> buttons{0};
  };
  std::string name_;
  std::shared_ptr<Shared> shared_;
  haptics::LeavableThread thread_;
};

}  // namespace

std::shared_ptr<DeflectionSource> makeInputSource(const InputNode& node, OpenInput open) {
  return std::make_shared<InputSource>(node, std::move(open));
}

std::unique_ptr<haptics::HapticDevice> makeTabletHand(const InputNode& node, double halfWidth, const Vec3& start, OpenInput open) {
  return std::make_unique<TabletHand>(node, halfWidth, start, std::move(open));
}

namespace {

const char* wordOf(InputKind kind) { return kind == InputKind::Keyboard ? "keyboard" : kind == InputKind::Gamepad ? "gamepad" : "tablet"; }

InputNode chooseNode(InputKind kind, const std::string& path, const std::string& words) {
  std::string why = fmt::format("no {} is among /dev/input/event*", wordOf(kind));
  for (const InputNode& node : findInputNodes(kind)) {
    if (!path.empty() && node.path != path) continue;
    if (node.whyNot.empty()) return node;
    why = node.whyNot;
  }
  throw ResourceError(fmt::format("{}: {}", words, why));
}

OpenInput opener(InputKind kind, const std::string& path, const std::string& words) {
  return [=] { return std::make_unique<InputPort>(chooseNode(kind, path, words).path); };
}

template <InputKind kKind>
std::unique_ptr<haptics::HapticDevice> makeSteered(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  RateHand::Options chosen;
  chosen.gain = options.number("gain", kKind == InputKind::Keyboard ? 0.15 : chosen.gain, 0.01, 5);
  chosen.deadZone = options.number("dead-zone", kKind == InputKind::Keyboard ? 0 : 0.1, 0, 0.5);
  options.done();
  const InputNode node = chooseNode(kKind, options.plain(), request.words());
  haptics::DeviceInfo info;
  info.name = node.name.empty() ? wordOf(kKind) : node.name;
  info.version = "evdev";
  info.rate = 125;
  return std::make_unique<RateHand>(info, chosen, startOf(request.experiment),
                                    makeInputSource(node, opener(kKind, options.plain(), request.words())));
}

std::unique_ptr<haptics::HapticDevice> makeTablet(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  const double halfWidth = options.number("half-width", 0.15, 0.01, 2);
  options.done();
  const InputNode node = chooseNode(InputKind::Tablet, options.plain(), request.words());
  return makeTabletHand(node, halfWidth, startOf(request.experiment), opener(InputKind::Tablet, options.plain(), request.words()));
}

template <InputKind kKind>
std::vector<FoundDevice> findInputs(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  std::string why = fmt::format("no {} is among /dev/input/event*", wordOf(kKind));
  for (const InputNode& node : findInputNodes(kKind)) {
    if (!node.whyNot.empty()) {
      why = node.whyNot;
      continue;
    }
    haptics::DeviceInfo info;
    info.name = node.name;
    info.rate = 125;
    info.degreesOfFreedom = kKind == InputKind::Tablet ? 2 : 3;
    found.push_back(presentDevice(self, self.name + ":" + node.path, info));
  }
  if (found.empty()) return {absentDevice(self, why)};
  return found;
}

}  // namespace

DeviceDriver keyboardDriver() {
  return {"keyboard", "keyboard[:PATH][,gain=M_PER_S]", "arrow keys and page up, page down steer the hand's speed",
          false,      findInputs<InputKind::Keyboard>,  makeSteered<InputKind::Keyboard>};
}

DeviceDriver gamepadDriver() {
  return {"gamepad",
          "gamepad[:PATH][,gain=M_PER_S,dead-zone=SHARE]",
          "the sticks of a gamepad or joystick steer the hand's speed",
          false,
          findInputs<InputKind::Gamepad>,
          makeSteered<InputKind::Gamepad>};
}

DeviceDriver tabletDriver() {
  return {"tablet", "tablet[:PATH][,half-width=M]", "the pen's place on a tablet is the hand's",
          false,    findInputs<InputKind::Tablet>,  makeTablet};
}

}  // namespace reachlab::devices
