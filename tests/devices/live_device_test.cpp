#include "devices/live_device.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "sim/experiment/experiment.h"
#include "tests/devices/fakes/fake_hidapi.h"
#include "tests/until.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

using test::until;

const experiment::CompiledExperiment& reach() {
  static const experiment::CompiledExperiment experiment(experiment::readExperiment("chain-slow"));
  return experiment;
}

// Whatever the clock does: each report's interval lies in its bin, so that together they last as long as the rate says.
void expectBinsToMatchTheRate(const LiveDevice::View& view) {
  const double lasted = static_cast<double>(view.reports) / view.rate;
  double least = 0, most = 0;
  std::uint64_t counted = 0;
  for (std::size_t i = 0; i < LiveDevice::kBins; ++i) {
    const auto count = static_cast<double>(view.between[i]);
    least += count * static_cast<double>(i) * LiveDevice::kBinSeconds;
    most += count * static_cast<double>(i + 1) * LiveDevice::kBinSeconds;
    counted += view.between[i];
  }
  EXPECT_EQ(counted, view.reports);
  constexpr double kRounding = 1e-9;  // [s]
  EXPECT_LE(least, lasted + kRounding);
  if (view.between.back() == 0) {
    EXPECT_GE(most + kRounding, lasted);
  }
}

TEST(LiveDevice, CountsTheTimesBetweenReportsOrTicks) {
  for (const char* device : {"virtual:omni", "simulated:noise=0"}) {
    LiveDevice live(device, reach());
    LiveDevice::View view;
    ASSERT_TRUE(until([&] { return (view = live.look()).reports > 100; })) << device;
    EXPECT_TRUE(view.valid);
    EXPECT_GT(view.rate, 0);
    EXPECT_LT(view.rate, 1100) << "no more than a tick's";
    expectBinsToMatchTheRate(view);
    EXPECT_EQ(view.fault, "");
    EXPECT_NEAR(view.position.x, -0.1, 1e-4) << "nothing is put up: it rests at the start";
    EXPECT_LT(view.speed, 1e-2);
    EXPECT_EQ(view.force, Vec3{});
    EXPECT_EQ(live.calibrationHint(), "");
    EXPECT_NO_THROW(live.calibrate());
  }
}

// An arm of ten milliseconds' reports: the loop asks it oftener than it has news.
TEST(LiveDevice, ReportsOfADeviceAreCountedByTheirNumber) {
  test::FakeHid arm{.path = "/dev/hidraw3", .vendor = 0x16C0, .product = 0x0486, .serial = L"A1"};
  arm.steady.assign(64, 0);
  arm.steady[6] = 0x10, arm.steady[7] = 0x27;  // its button is pressed
  test::resetFakeHids({arm});
  {
    LiveDevice live("hid:A1", reach());
    LiveDevice::View view;
    ASSERT_TRUE(until([&] { return (view = live.look()).reports > 50; }));
    expectBinsToMatchTheRate(view);
    EXPECT_EQ(view.buttons, 1u);
    EXPECT_EQ(live.info().name, "woodenhaptics_v2015 A1");
    EXPECT_EQ(live.calibrationHint(), "hold the arm in its calibration pose (encoders 0, 0, 6000)");
    EXPECT_NO_THROW(live.calibrate());
    test::setFirstFakeHid(true);
    ASSERT_TRUE(until([&] { return !(view = live.look()).fault.empty(); }));
    EXPECT_TRUE(holds(view.fault, "woodenhaptics_v2015 A1"));
    EXPECT_TRUE(until([&] { return live.look().fault.ends_with("is lost: no connection any more"); })) << live.look().fault;
  }
  test::resetFakeHids();
}

TEST(LiveDevice, OneThatCannotBeHadIsRefused) { EXPECT_THROW(LiveDevice("hid", reach()), ResourceError); }

}  // namespace
}  // namespace reachlab::devices
