#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "base/system/os.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/haptic_loop.h"
#include "sim/haptics/loop_core.h"
#include "sim/haptics/run_conductor.h"
#include "tests/haptics/armed_at_once.h"
#include "tests/until.h"
#include "tests/refusal.h"

/// The loop on devices that fail it. Waits are for events, never for a time to be short enough.
namespace reachlab::haptics {
namespace {

using reachlab::test::until;
using namespace std::chrono_literals;

// A hand that goes along x at a steady 0.1 m/s as soon as force may be felt, and a device that can be made to hang.
class FailingDevice : public HapticDevice {
 public:
  explicit FailingDevice(const Vec3& start) : start_(start) {}
  DeviceInfo info() const override { return {.name = "failing", .rendersForce = true}; }
  void cue(Cue cue) noexcept override { going_ = cue == Cue::Go; }
  DeviceSample read() noexcept override {
    hangIf(hangsInRead);
    DeviceSample sample;
    if (going_ && !frozen) {
      x_ += 1e-4;
      ++reports_;
    }
    sample.position = start_ + Vec3{x_ + (jump ? 0.1 : 0.0), 0, 0};
    sample.reports = frozen ? reports_ : ++reports_;
    return sample;
  }
  void write(const Vec3& force) noexcept override {
    hangIf(hangsInWrite);
    if (whileItIsTold && force != Vec3{}) whileItIsTold();
    lastForce = norm(force);
    if (norm(force) > most) most = norm(force);
  }
  DeviceHealth health() const noexcept override { return isLost ? DeviceHealth::Lost : DeviceHealth::Ready; }
  bool stopForce() noexcept override {
    ++stops;
    hangIf(hangsInStop);
    return true;
  }
  void letGo() {
    const std::lock_guard lock(mutex_);
    released_ = true;
    changed_.notify_all();
  }

  std::function<void()> whileItIsTold;  // of a force

  std::atomic<bool> hangsInRead{false}, hangsInWrite{false}, hangsInStop{false}, frozen{false}, jump{false}, isLost{false};
  std::atomic<double> lastForce{0}, most{0};
  std::atomic<int> stops{0}, hanging{0};

 private:
  void hangIf(const std::atomic<bool>& wanted) noexcept {
    if (!wanted) return;
    std::unique_lock lock(mutex_);
    ++hanging;
    changed_.wait(lock, [&] { return released_; });
    --hanging;
  }
  Vec3 start_;
  double x_ = 0;
  bool going_ = false, released_ = false;
  std::uint64_t reports_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

class LoopSafety : public ::testing::Test {
 protected:
  LoopSafety() : experiment(test::armedPatiently("chain-slow")) {
    auto engine = std::make_unique<TickEngine>(experiment, EngineOptions{});
    device = std::make_shared<FailingDevice>(engine->protocol().start);
    loop = std::make_unique<HapticLoop>(std::move(engine), device, nullptr);
  }
  ~LoopSafety() override { device->letGo(); }
  // Until a force of more than 1.2 N is felt: past the watch's 1 N.
  void engage() {
    loop->start();
    loop->tryCommand(trial::Command::NextTrial);
    ASSERT_TRUE(until([&] { return device->lastForce > 1.2; }));
  }
  bool isDone() {
    const TickState* state = loop->takeLatest();
    return state != nullptr && state->phase == trial::Phase::Done;
  }
  void expectLost(DeviceFault fault) {
    ASSERT_TRUE(until([&] { return loop->fault() == fault; }));
    ASSERT_TRUE(until([&] { return isDone(); }));
    loop->stop();
    EXPECT_EQ(loop->engine().state().result.reason, trial::Reason::DeviceLost);
    EXPECT_EQ(device->lastForce, 0);
  }

  experiment::Experiment experiment;
  std::shared_ptr<FailingDevice> device;
  std::unique_ptr<HapticLoop> loop;
};

TEST_F(LoopSafety, FrozenReportsEndInZeroAndTheTrialIsLost) {
  engage();
  device->frozen = true;
  expectLost(DeviceFault::Silent);
}

// Between trials, too: plugged in again, it may count its places from elsewhere.
TEST_F(LoopSafety, ADeviceThatWasLostForAMomentGetsNoForceUntilAPersonSaysSo) {
  loop->start();
  device->isLost = true;
  ASSERT_TRUE(until([&] { return loop->fault() == DeviceFault::Device; }));
  device->isLost = false;
  loop->tryCommand(trial::Command::NextTrial);
  ASSERT_TRUE(until([&] { return isDone(); }));
  EXPECT_EQ(device->most, 0);
  loop->resetFault();
  ASSERT_TRUE(until([&] { return loop->fault() == DeviceFault::None; }));
}

TEST_F(LoopSafety, AJumpUnderForceEndsTheTrialAndAfterAResetForceMayReturn) {
  engage();
  device->jump = true;
  ASSERT_TRUE(until([&] { return loop->fault() == DeviceFault::Jump; }));
  device->jump = false;
  ASSERT_TRUE(until([&] { return isDone() && device->lastForce == 0; }));
  loop->resetFault();
  ASSERT_TRUE(until([&] { return loop->fault() == DeviceFault::None; }));
}

TEST_F(LoopSafety, AHangingReadIsToldZeroByTheSecondPath) {
  engage();
  device->hangsInRead = true;
  ASSERT_TRUE(until([&] { return device->stops > 0; }));
  EXPECT_EQ(loop->fault(), DeviceFault::Stalled);
  EXPECT_TRUE(until([&] { return loop->hangs(); }));
}

TEST_F(LoopSafety, AReadThatHangsBetweenTrialsIsToldZeroWhileAStylusIsHeld) {
  EngineOptions options;
  options.hands[0].guards.compensation = {0, 3, 0};
  loop = std::make_unique<HapticLoop>(std::make_unique<TickEngine>(experiment, options), device, nullptr);
  loop->start();
  ASSERT_TRUE(until([&] { return device->lastForce > 2.9; }));
  const TickState* state = loop->takeLatest();
  ASSERT_NE(state, nullptr);
  EXPECT_FALSE(trial::isEngaged(state->phase));
  device->hangsInRead = true;
  EXPECT_TRUE(until([&] { return loop->fault() == DeviceFault::Stalled && device->stops > 0; }));
}

TEST_F(LoopSafety, WhenTheCallReturnsNoForceFollows) {
  engage();
  device->hangsInWrite = true;
  ASSERT_TRUE(until([&] { return device->stops > 0; }));
  device->hangsInWrite = false;
  device->letGo();
  ASSERT_TRUE(until([&] { return device->lastForce == 0; }));
  std::this_thread::sleep_for(50ms);
  EXPECT_EQ(device->lastForce, 0);
}

// Another thread has told the device zero just then: what it is told afterwards must be zero too.
TEST_F(LoopSafety, AFaultThatComesWhileTheDeviceIsToldItsForceLeavesNoForce) {
  LoopCore core(std::make_unique<TickEngine>(experiment, EngineOptions{}), device, nullptr);
  ASSERT_TRUE(core.commands.tryPush({trial::Command::NextTrial, {}}));
  std::int64_t now = 0;
  for (int tick = 0; tick < 5000 && device->lastForce < 1.2; ++tick) ASSERT_TRUE(core.tick(0, now += LoopCore::kPeriodNs));
  ASSERT_GT(device->lastForce, 1.2);
  device->whileItIsTold = [&] { core.latch(DeviceFault::Stalled); };
  ASSERT_TRUE(core.tick(0, now += LoopCore::kPeriodNs));
  EXPECT_EQ(core.latched.load().fault, DeviceFault::Stalled);
  EXPECT_EQ(device->lastForce, 0);
}

TEST_F(LoopSafety, StopReturnsThoughADeviceCallHangs) {
  engage();
  device->hangsInRead = true;
  ASSERT_TRUE(until([&] { return device->hanging > 0; }));
  loop->stop();  // would not return if it waited for the call
  loop.reset();
  device->letGo();
  EXPECT_TRUE(until([&] { return device->hanging == 0; }));
}

// The tick, the last word and the watchdog all hang. Who slept for twice the longest wait has not woken by then.
TEST_F(LoopSafety, StopWaitsOnceHoweverManyCallsHang) {
  engage();
  device->hangsInStop = true;
  device->hangsInRead = true;
  ASSERT_TRUE(until([&] { return device->hanging > 1; })) << "the read and the watchdog's word";
  std::atomic<bool> woken{false};
  std::jthread sleeper([&] {
    std::this_thread::sleep_for(2 * std::chrono::milliseconds(HapticLoop::kPatienceMs + HapticLoop::kLastWordMs));
    woken = true;
  });
  loop->stop();
  EXPECT_FALSE(woken);
  EXPECT_EQ(device->hanging, 3);
}

TEST_F(LoopSafety, ARunOnADeviceThatHangsEndsItsTrialAsLostAndSaysWhy) {
  auto engine = std::make_unique<TickEngine>(experiment, EngineOptions{});
  auto hanging = std::make_unique<FailingDevice>(engine->protocol().start);
  FailingDevice* const seen = hanging.get();
  auto run =
      std::make_unique<RunConductor>(experiment::CompiledExperiment(experiment), std::move(hanging), std::vector<trial::PlannedTrial>{{}});
  run->start(nullptr);
  std::jthread breaker([&] {
    until([&] { return seen->lastForce > 1.2; });
    seen->hangsInWrite = true;
  });
  const auto trial = run->runTrial(std::atomic<bool>{false});
  breaker.join();
  ASSERT_TRUE(trial);
  EXPECT_EQ(trial->result.outcome, trial::Outcome::Interrupted);
  EXPECT_EQ(trial->result.reason, trial::Reason::DeviceLost);
  const auto fault = run->fault();
  ASSERT_TRUE(fault);
  EXPECT_TRUE(holds(*fault, "stalled"));
  run->finish();
  seen->letGo();
}

// A device that calls for its ticks from its own thread.
class ClockDevice final : public FailingDevice {
 public:
  using FailingDevice::FailingDevice;
  DeviceInfo info() const override {
    DeviceInfo info = FailingDevice::info();
    info.drivesClock = true;
    return info;
  }
  void startClock(ClockTick tick, void* context) override {
    thread_ = std::jthread([this, tick, context](const std::stop_token& stop) {
      std::int64_t next = os::now();
      while (!stop.stop_requested()) {
        os::sleepUntil(next += 1'000'000);
        if (!silent) tick(context);
        if (twice) tick(context);
      }
    });
  }
  void stopClock() noexcept override {
    thread_.request_stop();
    if (thread_.joinable()) thread_.join();
  }
  std::atomic<bool> silent{false}, twice{false};

 private:
  std::jthread thread_;
};

TEST_F(LoopSafety, ADeviceMayBeTheClock) {
  auto engine = std::make_unique<TickEngine>(experiment, EngineOptions{});
  const auto clock = std::make_shared<ClockDevice>(engine->protocol().start);
  HapticLoop own(std::move(engine), clock, nullptr);
  own.start();
  own.tryCommand(trial::Command::NextTrial);
  ASSERT_TRUE(until([&] { return clock->lastForce > 0.1; }));
  EXPECT_TRUE(holds(own.report().mode, "device"));
  clock->silent = true;
  ASSERT_TRUE(until([&] { return own.fault() == DeviceFault::Stalled; }));
  EXPECT_GT(clock->stops, 0);
  own.stop();
  EXPECT_EQ(clock->lastForce, 0);
}

TEST_F(LoopSafety, ACallThatComesTwiceIsOneTick) {
  auto engine = std::make_unique<TickEngine>(experiment, EngineOptions{});
  const auto clock = std::make_shared<ClockDevice>(engine->protocol().start);
  clock->twice = true;
  HapticLoop own(std::move(engine), clock, nullptr);
  own.start();
  ASSERT_TRUE(until([&] { return own.report().ticks >= 300; }));
  own.stop();
  const LoopReport report = own.report();
  const double periods = report.seconds * 1000;
  EXPECT_NEAR(static_cast<double>(report.ticks + report.faults.missedTicks), periods + 1, 2) << "time is the monotonic clock's";
}

}  // namespace
}  // namespace reachlab::haptics
