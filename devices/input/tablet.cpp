#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <functional>

#include "base/device_options.h"
#include "base/error.h"
#include "base/system/os.h"
#include "devices/driver/drivers.h"
#include "devices/input/event_node.h"
#include "devices/mouse/mouse_device.h"
#include "sim/haptics/leavable_thread.h"
#include "sim/trial/task_places.h"

namespace reachlab::devices {
namespace {

constexpr int kWaitMs = 8;
constexpr std::int64_t kReopenNs = 200'000'000;

using ChooseTablet = std::function<TabletNode()>;  // throws ResourceError while the tablet is not present

haptics::DeviceInfo infoOf(const TabletNode& node) {
  return {.name = node.name.empty() ? "tablet" : node.name, .version = "evdev", .degreesOfFreedom = 2, .rate = 200};
}

/// Reads events, and opens the node again after it was lost.
class InputReader {
 public:
  InputReader(const TabletNode& node, ChooseTablet choose)
      : state_(node), node_(node), choose_(std::move(choose)), port_(std::make_unique<InputPort>(node.path)) {}

  /// Calls `each` at the end of every report that came within kWaitMs. False: it is gone.
  template <typename Each>
  bool read(Each&& each) {
    if (!port_ && !reopen()) return false;
    std::array<input_event, 64> events{};
    const int got = port_->read(events, kWaitMs);
    if (got < 0) {
      port_.reset();
      state_ = PenState(node_);  // no pen is near a tablet that is gone
      return false;
    }
    for (int i = 0; i < got; ++i) {
      const input_event& event = events[static_cast<std::size_t>(i)];
      if (state_.take(event)) each(event.input_event_sec * 1'000'000'000 + event.input_event_usec * 1000);
    }
    return true;
  }
  const PenState& state() const { return state_; }

 private:
  bool reopen() {
    os::sleepUntil(os::now() + kReopenNs);
    try {
      port_ = std::make_unique<InputPort>(choose_().path);
      return true;
    } catch (const ResourceError&) {
      return false;
    }
  }
  PenState state_;
  TabletNode node_;
  ChooseTablet choose_;
  std::unique_ptr<InputPort> port_;
};

/// A pen on a tablet. The position of the pen is the position of the hand in the plane of x and y. The distance from the middle to the
/// right edge is `halfWidth` [m]. Events are played back by their own times, as those of the mouse are (mouse_device.h).
class TabletHand final : public haptics::HapticDevice {
 public:
  TabletHand(const TabletNode& node, double halfWidth, const Vec3& start, ChooseTablet choose)
      : info_(infoOf(node)), shared_(std::make_shared<Shared>(start)) {
    auto reader = std::make_shared<InputReader>(node, std::move(choose));
    thread_ = haptics::LeavableThread([shared = shared_, reader, halfWidth, middle = Vec3{0, 0, start.z}] {
      while (!shared->stopping.load(std::memory_order_acquire)) {
        const bool there = reader->read([&](std::int64_t ns) {
          if (const auto pen = reader->state().position()) shared->hand.point(middle + halfWidth * *pen, ns);
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
  haptics::DeviceInfo info() const override { return info_; }
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
  haptics::DeviceInfo info_;
  std::shared_ptr<Shared> shared_;
  haptics::LeavableThread thread_;
};

constexpr const char* kNone = "no tablet is among /dev/input/event*";

TabletNode chooseTablet(const std::string& path, const std::string& words) {
  std::string why = kNone;
  for (const TabletNode& node : listTablets()) {
    if (!path.empty() && node.path != path) continue;
    if (node.whyNot.empty()) return node;
    why = node.whyNot;
  }
  throw ResourceError(fmt::format("{}: {}", words, why));
}

std::unique_ptr<haptics::HapticDevice> makeTablet(const DeviceRequest& request) {
  DeviceOptions options(request.argument, request.words());
  const double halfWidth = options.number("half-width", 0.15, 0.01, 2);
  options.done();
  const auto choose = [path = options.plain(), words = request.words()] { return chooseTablet(path, words); };
  return std::make_unique<TabletHand>(choose(), halfWidth, trial::startOf(request.experiment), choose);
}

std::vector<FoundDevice> findTabletDevices(const DeviceDriver& self) {
  std::vector<FoundDevice> found;
  std::string why = kNone;
  for (const TabletNode& node : listTablets()) {
    if (node.whyNot.empty()) found.push_back(presentDevice(self, node.path, infoOf(node)));
    else why = node.whyNot;
  }
  return rowsOr(std::move(found), self, why);
}

}  // namespace

DeviceDriver tabletDriver() {
  return {"tablet", "tablet[:PATH][,half-width=M]", "the pen's place on a tablet is the hand's", findTabletDevices, makeTablet};
}

}  // namespace reachlab::devices
