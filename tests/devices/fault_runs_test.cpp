#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <chrono>
#include <functional>
#include <limits>
#include <optional>
#include <rapidcheck.h>
#include <set>
#include <thread>

#include "base/error.h"
#include "devices/haply/haply_device.h"
#include "devices/hid/open_arm_device.h"
#include "devices/hid/open_serial_arm.h"
#include "devices/serial/polhem_device.h"
#include "devices/serial/polhem_line.h"
#include "devices/vendor/force_dimension.h"
#include "devices/vendor/phantom_device.h"
#include "devices/virtual/device_model.h"
#include "devices/virtual/virtual_device.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/force_safety.h"
#include "sim/haptics/loop_core.h"
#include "sim/haptics/watchdog.h"
#include "tests/devices/arm_poses.h"
#include "tests/devices/fakes/fake_dhd.h"
#include "tests/devices/fakes/fake_hd.h"
#include "tests/devices/fakes/fake_hidapi.h"
#include "tests/devices/invented_clock.h"
#include "tests/haptics/set_device.h"

/// Every driver that renders force, behind the whole loop, on invented time, with faults mixed at random (seeded: RC_PARAMS). What must hold
/// at every tick is in `Run`. RC_PARAMS="max_success=1000" runs a thousand of each (tests/long/fault_runs.sh).
namespace reachlab::devices {
namespace {

using haptics::test::SetDevice;

const int kSeeded = ::setenv("RC_PARAMS", "seed=20260101 max_success=40", 0);

enum class DeviceFault { NotANumber, Jump, Silence, Garbage, Unplug, Refusal, Gap, Stall };
struct FaultEvent {
  DeviceFault kind = DeviceFault::Gap;
  int from = 0, ticks = 1;
};
struct Plan {
  double stiffness = 600, mass = 1, limit = 0;  // limit [N] of the experiment, 0: none
  double reach = 0.1, period = 1;               // [m], [s] of the hand
  std::vector<FaultEvent> faults;
  bool resets = false;  // the experimenter resets a latched fault when the faults are over
};

/// One driver on a model of its device.
class Rig {
 public:
  /// `own`: faults that the device itself may report. `most`: the largest command that its motors may get.
  Rig(std::set<DeviceFault> own, double most) : toldLimit(most), own_(std::move(own)) {}
  virtual ~Rig() = default;
  virtual std::shared_ptr<haptics::HapticDevice> open() = 0;
  /// One millisecond of the device and its I/O; then `tick`, unless the tick hangs.
  virtual void advance(const std::function<void()>& tick) = 0;
  /// What the device's motors were last told, in its own unit: 0 is none.
  virtual double told() const = 0;
  void moveTo(const Vec3& world) { place = world; }
  void set(DeviceFault kind, bool active) { faults[static_cast<std::size_t>(kind)] = active; }
  bool has(DeviceFault kind) const { return faults[static_cast<std::size_t>(kind)]; }
  bool knows(DeviceFault kind) const { return kind == DeviceFault::Gap || kind == DeviceFault::Stall || own_.contains(kind); }
  virtual bool refuses() const { return false; }
  const double toldLimit;

 protected:
  Vec3 seen() const { return place + (has(DeviceFault::Jump) ? Vec3{0.05, 0, 0} : Vec3{}); }
  Vec3 place;
  std::array<bool, 8> faults{};

 private:
  std::set<DeviceFault> own_;
};

/// Behind a PolledDevice that is stepped.
class PolledRig : public Rig {
 public:
  using Rig::Rig;
  std::shared_ptr<haptics::HapticDevice> open() override {
    polled_ = std::make_shared<PolledDevice>(transport(), inventedNow);
    for (int i = 0; i < 3; ++i) advance({});
    return polled_;
  }
  void advance(const std::function<void()>& tick) override {
    serve();
    polled_->step();
    if (tick) tick();
  }
  bool refuses() const override { return has(DeviceFault::Refusal); }

 protected:
  virtual std::shared_ptr<Transport> transport() = 0;
  virtual void serve() = 0;  // the device's own millisecond
  std::shared_ptr<PolledDevice> polled_;
};

class ArmRig final : public PolledRig {
 public:
  ArmRig() : PolledRig({DeviceFault::Jump, DeviceFault::Silence, DeviceFault::Garbage, DeviceFault::Unplug, DeviceFault::Refusal}, 2000) {}
  ~ArmRig() override {
    polled_.reset();
    test::resetFakeHids();
  }
  void advance(const std::function<void()>& tick) override {
    PolledRig::advance(tick);
    if (hid_.written.empty()) return;
    told_ = largestCurrent(hid_.written.back());
    answered_ = inventedNs;
    hid_.written.clear();
  }
  double told() const override { return told_; }

 protected:
  std::shared_ptr<Transport> transport() override {
    return std::make_shared<OpenArm>(OpenArm::Options{.model = findArmModel("woodenhaptics_v2015")}, "1",
                                     [this] { return std::make_unique<HidPort>(HidInterface{.path = hid_.path}); });
  }
  void serve() override {
    if (inventedNs - answered_ > 500 * kMs || has(DeviceFault::Unplug)) told_ = 0;  // the firmware's watchdog; no current without a cable
    hid_.gone = has(DeviceFault::Unplug), hid_.deaf = has(DeviceFault::Refusal);
    if (has(DeviceFault::Silence)) return;
    const ArmModel& model = *findArmModel("woodenhaptics_v2015");
    const Vec3 at = seen();
    const auto counts = encoderCounts(model, anglesAt(model, {at.z, at.x, at.y}));
    hid_.reports = {armReport(counts)};
    if (has(DeviceFault::Garbage)) hid_.reports[0].resize(7);
  }
  test::FakeHid& hid_ = test::resetToOneFakeHid();
  double told_ = 0;  // [mA]
  std::int64_t answered_ = 0;
};

/// Behind a link that answers each message once.
class MessageRig : public PolledRig {
 public:
  double told() const override { return told_; }

 protected:
  struct Link final : MessageLink {
    explicit Link(MessageRig& r) : rig(r) {}
    ~Link() override {
      if (rig.letsGo_) rig.told_ = 0;
    }
    bool send(std::string_view message) noexcept override {
      if (rig.has(DeviceFault::Unplug) || rig.has(DeviceFault::Refusal)) return false;
      if (const auto force = rig.forceIn(std::string(message))) rig.told_ = norm(*force);
      rig.asked_ = true;
      rig.answered_ = inventedNs;
      return true;
    }
    Got receive(std::string& message, int) noexcept override {
      if (rig.has(DeviceFault::Unplug)) return Got::Gone;
      if (!rig.asked_ || rig.has(DeviceFault::Silence)) return Got::Nothing;
      rig.asked_ = false;
      message = rig.has(DeviceFault::Garbage) ? "?? }{" : rig.stateAt(rig.seen());
      return Got::Message;
    }
    std::string fault() const override { return "gone"; }
    MessageRig& rig;
  };
  MessageRig(bool letsGo, double most)
      : PolledRig({DeviceFault::NotANumber, DeviceFault::Jump, DeviceFault::Silence, DeviceFault::Garbage, DeviceFault::Unplug,
                   DeviceFault::Refusal},
                  most),
        letsGo_(letsGo) {}
  std::unique_ptr<MessageLink> link() {
    if (has(DeviceFault::Unplug)) throw ResourceError("gone");
    return std::make_unique<Link>(*this);
  }
  void serve() override {
    if (has(DeviceFault::Unplug) || (!letsGo_ && inventedNs - answered_ > 500 * kMs)) told_ = 0;  // the firmware's watchdog
  }
  virtual std::optional<Vec3> forceIn(const std::string& message) const = 0;  // [N], its own axes
  virtual std::string stateAt(const Vec3& at) const = 0;
  bool letsGo_;      // of the force when its client is gone
  double told_ = 0;  // [N]
  bool asked_ = false;
  std::int64_t answered_ = 0;
};

class PolhemRig final : public MessageRig {
 public:
  PolhemRig() : MessageRig(false, 5.002) {}   // each axis is rounded to a millinewton
  ~PolhemRig() override { polled_.reset(); }  // what it sends last goes through this rig

 protected:
  std::optional<Vec3> forceIn(const std::string& line) const override {
    int x = 0, y = 0, z = 0;
    std::sscanf(line.c_str(), "%d %d %d", &x, &y, &z);
    return Vec3{1e-3 * x, 1e-3 * y, 1e-3 * z};
  }
  std::string stateAt(const Vec3& at) const override {
    if (has(DeviceFault::NotANumber)) return "nan nan nan 0 0 0 0 0";
    return fmt::format("{:.3f} {:.3f} {:.3f} 0 0 0 0 0", 1e3 * at.z, 1e3 * at.x, 1e3 * at.y);
  }
  std::shared_ptr<Transport> transport() override {
    return std::make_shared<PolhemSerial>("Polhem", [this] { return link(); });
  }
};

class HaplyRig final : public MessageRig {
 public:
  HaplyRig() : MessageRig(true, 10) {}
  ~HaplyRig() override { polled_.reset(); }

 protected:
  std::optional<Vec3> forceIn(const std::string& message) const override {
    Vec3 f;
    const std::size_t at = message.find("\"values\":");
    if (at == std::string::npos) return std::nullopt;
    const int read = std::sscanf(message.c_str() + at, R"("values":{"x":%lf,"y":%lf,"z":%lf)", &f.x, &f.y, &f.z);
    return read == 3 ? std::optional(f) : std::nullopt;
  }
  std::string stateAt(const Vec3& at) const override {
    const std::string axes = has(DeviceFault::NotANumber) ? R"("x":1e999)" : fmt::format(R"("x":{},"y":{},"z":{})", at.x, -at.z, at.y);
    return R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{)" + axes + "}}}]}";
  }
  std::shared_ptr<Transport> transport() override {
    return std::make_shared<HaplyInverse3>(HaplyInverse3::Options{}, [this] {
      asked_ = true;  // it greets
      return link();
    });
  }
};

class ForceDimensionRig final : public PolledRig {
 public:
  ForceDimensionRig() : PolledRig({DeviceFault::NotANumber, DeviceFault::Jump, DeviceFault::Unplug, DeviceFault::Refusal}, 12) {
    test::resetFakeDhd();
  }
  double told() const override {
    const auto& f = test::fakeDhd().force;
    return test::fakeDhd().error != 0 || !test::fakeDhd().open ? 0 : std::hypot(f[0].load(), f[1].load(), f[2].load());
  }

 protected:
  std::shared_ptr<Transport> transport() override { return openForceDimension(0, "device forcedimension:0", false); }
  void serve() override {
    const Vec3 at = seen();
    auto& fake = test::fakeDhd();
    fake.position[0] = has(DeviceFault::NotANumber) ? std::numeric_limits<double>::quiet_NaN() : at.z;
    fake.position[1] = at.x, fake.position[2] = at.y;
    fake.error = has(DeviceFault::Unplug) ? 5 : 0;
    if (has(DeviceFault::Refusal)) fake.failOnce = 2;
  }
};

class PhantomRig final : public Rig {
 public:
  PhantomRig() : Rig({DeviceFault::NotANumber, DeviceFault::Jump, DeviceFault::Unplug, DeviceFault::Refusal}, 3.3) { test::resetFakeHd(); }
  std::shared_ptr<haptics::HapticDevice> open() override {
    device_ = std::make_shared<PhantomDevice>(PhantomDevice::Options{});
    device_->startClock(
        [](void* self) noexcept {
          auto& rig = *static_cast<PhantomRig*>(self);
          if (rig.tick_) rig.tick_();
        },
        this);
    return device_;
  }
  ~PhantomRig() override {
    if (!device_) return;
    tick_ = nullptr;
    const std::jthread servo([](const std::stop_token& stop) {  // the last frames, which stopping waits for
      while (!stop.stop_requested()) {
        test::stepFakeHd();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
    device_.reset();
  }
  void advance(const std::function<void()>& tick) override {
    auto& fake = test::fakeHd();
    const Vec3 at = seen();
    auto& one = fake.devices[""];
    one.position[0] = has(DeviceFault::NotANumber) ? std::numeric_limits<double>::quiet_NaN() : 1e3 * at.x;
    one.position[1] = 1e3 * at.y, one.position[2] = 1e3 * at.z;
    if (has(DeviceFault::Unplug)) fake.failures["hdEndFrame"] = 0x0302;
    if (has(DeviceFault::Refusal)) fake.failures["hdSetDoublev"] = 0x0203;
    tick_ = tick;
    if (tick) test::stepFakeHd();  // a tick that hangs holds the scheduler
    tick_ = nullptr;
  }
  double told() const override {
    const auto& f = test::fakeHd().devices[""].force;
    return std::hypot(f[0], f[1], f[2]);
  }

 private:
  std::shared_ptr<PhantomDevice> device_;
  std::function<void()> tick_;
};

class VirtualRig final : public Rig {
 public:
  VirtualRig() : Rig({DeviceFault::Silence, DeviceFault::Jump}, 8.5) {}
  std::shared_ptr<haptics::HapticDevice> open() override {
    auto hand = std::make_unique<SetDevice>();
    hand_ = hand.get();
    return device_ = std::make_shared<VirtualDevice>(*findDeviceModel("premium15"), VirtualDevice::Options{.hand = {1, 300, 30}},
                                                     std::move(hand));
  }
  void advance(const std::function<void()>& tick) override {
    hand_->sample.position = seen();
    hand_->sample.valid = !has(DeviceFault::Silence);
    if (tick) tick();
  }
  double told() const override { return 0; }

 private:
  SetDevice* hand_ = nullptr;  // what holds the device
  std::shared_ptr<VirtualDevice> device_;
};

/// What the loop tells the device, tick for tick.
class Tapped final : public haptics::HapticDevice {
 public:
  Tapped(std::shared_ptr<haptics::HapticDevice> device, bool guarded) : device_(std::move(device)), guarded_(guarded) {}
  haptics::DeviceInfo info() const override {
    haptics::DeviceInfo info = device_->info();
    info.rendersForce = guarded_;
    return info;
  }
  void prepareTrial(int index, int scene = 0) override { device_->prepareTrial(index, scene); }
  void cue(haptics::Cue cue) noexcept override { device_->cue(cue); }
  haptics::DeviceSample read() noexcept override { return device_->read(); }
  void write(const Vec3& force) noexcept override {
    if (!isFinite(force)) notFinite = true;
    largest = std::max(largest, norm(force));
    last = force;
    device_->write(force);
  }
  haptics::DeviceHealth health() const noexcept override { return device_->health(); }
  bool stopForce() noexcept override { return device_->stopForce(); }
  Vec3 last;
  double largest = 0;
  bool notFinite = false;

 private:
  std::shared_ptr<haptics::HapticDevice> device_;
  bool guarded_;
};

bool isLoss(DeviceFault kind) { return kind == DeviceFault::Silence || kind == DeviceFault::Unplug || kind == DeviceFault::Garbage; }

/// One run. At every tick: the force is finite, within the limit, changes by no more than the slew limit or goes to zero; it is zero from
/// the 20th tick of any loss on; after a latch nothing until the experimenter resets it; the motors hear no more than they may.
void runPlan(Rig& rig, const Plan& plan, bool guarded = true) {
  experiment::Experiment experiment = experiment::readExperiment("chain-slow");
  experiment.task->rest = experiment::kNoStartRest;
  experiment.object = {};
  experiment.object.masses = {plan.mass};
  experiment.coupling = {plan.stiffness, 0};
  if (plan.limit > 0) experiment.forceLimit = plan.limit;
  inventedNs = 1'000'000 * kMs;
  rig.moveTo({-0.1, 0, 0});
  const auto device = std::make_shared<Tapped>(rig.open(), guarded);
  const haptics::DeviceInfo info = device->info();
  auto engine = std::make_unique<haptics::TickEngine>(experiment, haptics::EngineOptions{{info}});
  haptics::LoopCore core(std::move(engine), device, nullptr);
  const double limit = plan.limit > 0 ? std::min(plan.limit, info.maxForce) : info.maxForce;
  constexpr int kTicks = 600;
  constexpr double kRounding = 1e-9;
  Vec3 before;
  int lostFor = 0, latchedFor = 0, goneFor = 0;
  double moved = 0;  // [s] of the hand's own time, while it is engaged
  for (int tick = 0; tick < kTicks; ++tick) {
    std::uint32_t missed = 0;
    bool lost = false, any = false;
    for (const FaultEvent& fault : plan.faults) {
      const bool active = tick >= fault.from && tick < fault.from + fault.ticks;
      any = any || active;
      if (!rig.knows(fault.kind)) continue;
      if (fault.kind == DeviceFault::Gap && active && (tick - fault.from) % 50 == 0) missed += static_cast<std::uint32_t>(fault.ticks % 30);
      if (fault.kind == DeviceFault::Stall && tick == fault.from) {
        // The tick hangs; device and watchdog go on.
        const std::int64_t since = inventedNs;
        for (int ms = 0; ms < 25 + fault.ticks % 50; ++ms, inventedNs += kMs, ++missed) {
          rig.advance({});
          const auto latched = haptics::judgeLoop({inventedNs, since, core.forceOn.load(), info.drivesClock});
          if (latched != haptics::DeviceFault::None) {
            core.latch(latched);
            device->stopForce();
          }
          if (inventedNs - since > 21 * kMs && !info.drivesClock && !rig.refuses()) RC_ASSERT(rig.told() == 0);
        }
      }
      if (fault.kind == DeviceFault::Gap || fault.kind == DeviceFault::Stall) continue;
      bool other = false;  // two of one kind may overlap
      for (const FaultEvent& one : plan.faults)
        other = other || (one.kind == fault.kind && tick >= one.from && tick < one.from + one.ticks);
      rig.set(fault.kind, other);
      lost = lost || (other && isLoss(fault.kind));
    }
    lostFor = lost ? lostFor + 1 + static_cast<int>(missed) : 0;
    const haptics::TickState& state = core.engine->state();
    if (state.phase == trial::Phase::Idle || state.phase == trial::Phase::Done) {
      core.commands.tryPush({trial::Command::NextTrial, {}});
      moved = 0;
    }
    if (trial::isEngaged(state.phase)) moved += 1e-3;
    rig.moveTo({-0.1 + plan.reach * 0.5 * (1 - std::cos(2 * M_PI * moved / plan.period)), 0, 0});
    if (plan.resets && !any && core.hasFault() && latchedFor > 50) core.resetAsked = true;
    inventedNs += kMs * (1 + missed);

    const bool latchedBefore = core.hasFault() && !core.resetAsked.load();
    device->largest = 0;
    bool ticked = false;
    rig.advance([&] {
      core.tick(missed, inventedNs);
      ticked = true;
    });
    if (!ticked) continue;
    const Vec3 force = device->last;
    RC_ASSERT(!device->notFinite);
    RC_ASSERT(device->largest <= limit + kRounding);
    RC_ASSERT((norm(force - before) <= haptics::ForceSafety::kSlewPerTick + kRounding || force == Vec3{}));
    if (lostFor >= 20) RC_ASSERT(force == Vec3{});
    if (latchedBefore) RC_ASSERT(device->largest == 0);
    RC_ASSERT(rig.told() <= rig.toldLimit + kRounding);
    // A device that is lost but still takes reports is told zero; one that refuses them can only be left to its own watchdog.
    const bool refuses = rig.refuses();
    goneFor = device->health() == haptics::DeviceHealth::Lost && !refuses ? goneFor + 1 : 0;
    if (goneFor >= 20) RC_ASSERT(rig.told() == 0);
    latchedFor = core.hasFault() ? latchedFor + 1 : 0;
    before = force;
  }
}

Plan anyPlan() {
  Plan plan;
  plan.stiffness = *rc::gen::element(1.0, 120.0, 600.0, 2000.0, 1e5);
  plan.mass = *rc::gen::element(1e-3, 0.6, 3.0, 1000.0);
  plan.limit = *rc::gen::element(0.0, 0.0, 0.05, 2.0, 1e6);
  plan.reach = *rc::gen::element(0.0, 0.02, 0.1, 0.2);
  plan.period = *rc::gen::element(0.2, 0.7, 2.0);
  plan.resets = *rc::gen::arbitrary<bool>();
  const int count = *rc::gen::inRange(0, 6);
  for (int i = 0; i < count; ++i)
    plan.faults.push_back({static_cast<DeviceFault>(*rc::gen::inRange(0, 8)), *rc::gen::inRange(1, 600), *rc::gen::inRange(1, 250)});
  return plan;
}

template <class AnyRig>
void checkRandomRuns() {
  ASSERT_TRUE(rc::check([] {
    AnyRig rig;
    const Plan plan = anyPlan();
    runPlan(rig, plan);
  }));
}

TEST(FaultRuns, OpenArm) { checkRandomRuns<ArmRig>(); }
TEST(FaultRuns, Polhem) { checkRandomRuns<PolhemRig>(); }
TEST(FaultRuns, Haply) { checkRandomRuns<HaplyRig>(); }
TEST(FaultRuns, ForceDimension) { checkRandomRuns<ForceDimensionRig>(); }
TEST(FaultRuns, Phantom) { checkRandomRuns<PhantomRig>(); }
TEST(FaultRuns, Virtual) { checkRandomRuns<VirtualRig>(); }

// The check itself can fail: where nothing looks after a device, a silent one goes on being told the force.
TEST(FaultRuns, SilenceIsFoundWhereNothingLooksAfterTheDevice) {
  // A mass that does not follow: the force stands.
  const Plan plan{.mass = 1000, .reach = 0.02, .faults = {{DeviceFault::Silence, 300, 250}}};
  const auto run = [&](bool guarded) {
    ArmRig rig;
    runPlan(rig, plan, guarded);
  };
  EXPECT_NO_THROW(run(true));
  EXPECT_THROW(run(false), rc::detail::CaseResult);
}

}  // namespace
}  // namespace reachlab::devices
