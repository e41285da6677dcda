// What is plugged in, as hidapi tells it, behind the drivers that look for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>

#include "base/error.h"
#include "base/fault.h"
#include "devices/driver/registry.h"
#include "devices/hid/hid_port.h"
#include "devices/hid/open_serial_arm.h"
#include "devices/hid/report_descriptor.h"
#include "devices/hot_plug.h"
#include "tests/devices/arm_poses.h"
#include "tests/devices/driver_answers.h"
#include "tests/devices/fakes/fake_hidapi.h"
#include "tests/refusal.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::FakeHid;
using test::fakeHids;
using test::until;
using Bytes = std::vector<std::uint8_t>;

FakeHid teensy(const std::string& path = "/dev/hidraw3", const std::wstring& serial = L"A1") {
  return {.path = path,
          .vendor = 0x16C0,
          .product = 0x0486,
          .serial = serial,
          .maker = L"KTH",
          .title = L"Arm",
          .descriptor = vendorPage(64),
          .steady = Bytes(64, 0)};
}
FakeHid mbed() {
  return {.path = "/dev/hidraw4", .vendor = 0x1234, .product = 0x0006, .descriptor = vendorPage(14), .steady = Bytes(14, 0)};
}
FakeHid spaceMouse(std::uint16_t vendor = 0x256F, std::uint16_t product = 0xC635) {
  return {.path = "/dev/hidraw5",
          .vendor = vendor,
          .product = product,
          .serial = L"",
          .title = L"SpaceMouse Compact",
          .steady = {1, 0x5E, 0x01, 0, 0, 0, 0}};  // full push to the right
}

class HidDevices : public ::testing::Test, public DriverAnswers {
 protected:
  ~HidDevices() override { test::resetFakeHids(); }
  static std::vector<Bytes> written(std::size_t i = 0) {
    const std::lock_guard lock(fakeHids().mutex);
    return fakeHids().list[i].written;
  }
};

TEST_F(HidDevices, InterfacesComeInTheOrderOfTheirPathsWithTheirStrings) {
  test::resetFakeHids({teensy("/dev/hidraw9", L"Z"), mbed(), teensy("/dev/hidraw1", L"S\u00e9r\x7f~\x1f ")});
  const auto all = findHid();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].path, "/dev/hidraw1");
  EXPECT_EQ(all[0].serial, "S?r?~? ") << "what is not ASCII is shown as a question mark";
  EXPECT_EQ(all[0].maker, "KTH");
  EXPECT_EQ(all[0].title, "Arm");
  EXPECT_EQ(all[0].key(), all[0].serial);
  EXPECT_EQ(all[1].key(), "/dev/hidraw4") << "one without a serial number is named by its path";
  EXPECT_EQ(all[1].vendor, 0x1234);
  EXPECT_EQ(all[1].product, 6);
  EXPECT_EQ(all[2].path, "/dev/hidraw9");
  EXPECT_EQ(findHid(0x16C0).size(), 2u);
  EXPECT_EQ(findHid(0x16C0, 1).size(), 0u);
  EXPECT_EQ(findHid(0, 6).size(), 1u);
}

TEST_F(HidDevices, OneThatMayNotBeOpenedSaysWhatToDo) {
  const auto why = [&](int error) {
    FakeHid hid = teensy();
    hid.closedBy = error;
    test::resetFakeHids({hid});
    return whyNotOpen(findHid().at(0));
  };
  EXPECT_EQ(why(0), "");
  const std::string remedy = "; install packaging/udev/70-reachlab.rules and plug it in again";
  EXPECT_EQ(why(EACCES), "/dev/hidraw3: Permission denied" + remedy);
  EXPECT_EQ(why(EPERM), "/dev/hidraw3: Operation not permitted" + remedy);
  EXPECT_EQ(why(ENXIO), "/dev/hidraw3: No such device or address");
  EXPECT_THROW(HidPort(findHid().at(0)), ResourceError);
  EXPECT_EQ(reachlab::refusalOf([&] { const HidPort port(HidInterface{.path = "/dev/null"}); }), "/dev/null: the library?s own words")
      << "it may be opened, but not as HID";
}

TEST_F(HidDevices, APortIsReadWrittenAndClosed) {
  FakeHid hid = teensy();
  hid.steady.clear();
  hid.reports = {{1, 2, 3}};
  test::resetFakeHids({hid});
  {
    HidPort port(findHid().at(0));
    Bytes report(8);
    EXPECT_EQ(port.read(report, 5), 3);
    EXPECT_EQ(report[2], 3);
    EXPECT_EQ(port.read(report, 0), 0);
    EXPECT_TRUE(port.write(Bytes{0, 9}));
    fakeHids().list[0].gone = true;
    EXPECT_EQ(port.read(report, 0), -1);
    EXPECT_FALSE(port.write(Bytes{0, 9}));
  }
  EXPECT_EQ(fakeHids().list[0].waits, (std::vector<int>{5, 0, 0}));
  EXPECT_EQ(fakeHids().list[0].open, 0);
}

TEST_F(HidDevices, ArmsAreListedByTheNamesThatOpenThem) {
  EXPECT_EQ(rows("hid").at(0).whyNot, "no WoodenHaptics or Polhem arm (USB 16c0:0486 or 1234:0006) is connected");
  FakeHid closed = teensy("/dev/hidraw8", L"C"), old = teensy("/dev/hidraw9", L"O"), noMaker = teensy();
  closed.closedBy = EACCES;
  closed.descriptor = vendorPage(8);
  old.descriptor = vendorPage(13);
  noMaker.maker.clear();
  test::resetFakeHids({noMaker, mbed(), closed, old, spaceMouse()});
  const auto found = rows("hid");
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].name, "hid:A1");
  EXPECT_EQ(found[0].description, "Arm");
  EXPECT_EQ(found[0].maxForce, 5);
  EXPECT_TRUE(found[0].present);
  EXPECT_EQ(found[1].name, "hid:C");
  EXPECT_FALSE(found[1].present);
  EXPECT_EQ(found[1].description, "KTH Arm");
  EXPECT_TRUE(holds(found[1].whyNot, "Permission denied")) << "before its firmware: " << found[1].whyNot;
  EXPECT_FALSE(found[2].present);
  EXPECT_TRUE(holds(found[2].whyNot, "reports of 13 bytes, and 14 are needed"));
  EXPECT_EQ(found[3].name, "hid:/dev/hidraw4") << "the older ones behind";
  EXPECT_EQ(found[3].description, findDriver("hid")->description) << "one that has no title";
  EXPECT_TRUE(found[3].present) << "14 bytes are enough";
  for (const FakeHid& hid : fakeHids().list) EXPECT_EQ(hid.opened, 0) << "nothing is opened for it";
}

TEST_F(HidDevices, AnArmWhoseDescriptorIsNotKnownIsLeftToItsFirstReports) {
  FakeHid silent = teensy(), broken = teensy("/dev/hidraw8", L"B");
  silent.descriptor.clear();
  broken.descriptor = {0x05};
  test::resetFakeHids({silent, broken});
  for (const FoundDevice& row : rows("hid")) EXPECT_TRUE(row.present) << row.whyNot;
}

// A firmware that is too old is told by its descriptor. What cannot be read there is no reason to refuse the arm.
TEST(ReportDescriptor, TheSizeOfAnInputReportIsTheSumOfItsFieldsInWholeBytes) {
  const auto bytesOf = [](const Bytes& descriptor) { return inputReportBytes(descriptor); };
  EXPECT_EQ(bytesOf(vendorPage(64)), 64u);
  EXPECT_EQ(bytesOf({0x75, 3, 0x95, 2, 0x81, 2, 0x81, 3, 0x91, 2, 0xB1, 2}), 2u) << "12 bits, padding too, output and feature not";
  EXPECT_EQ(bytesOf({0x76, 8, 0, 0x97, 0, 0, 1, 0, 0x81, 2}), 65536u) << "sizes of two and four bytes";
  const std::vector<Bytes> notRead{{},
                                   {0x75},
                                   {0x07, 1, 2, 3},
                                   {0xFE, 1, 2},
                                   {0x85, 1, 0x75, 8, 0x95, 1, 0x81, 2},
                                   {0x75, 8, 0x95, 1, 0xA4, 0x81, 2},
                                   {0x75, 8, 0x95, 1, 0xB4, 0x81, 2},
                                   {0x77, 0, 0, 0, 0x80, 0x95, 2, 0x81, 2},
                                   {0x75, 8, 0x97, 1, 0, 1, 0, 0x81, 2}};
  for (std::size_t i = 0; i < notRead.size(); ++i) EXPECT_EQ(bytesOf(notRead[i]), 0u) << i;
}

TEST_F(HidDevices, AnArmIsChosenBySerialNumberOrPathOrTheFirst) {
  EXPECT_EQ(refusalOf("hid"), "device hid: no WoodenHaptics or Polhem arm (USB 16c0:0486 or 1234:0006) is connected");
  test::resetFakeHids({teensy("/dev/hidraw3", L"A1"), teensy("/dev/hidraw4", L"A2")});
  EXPECT_EQ(make("hid")->info().name, "woodenhaptics_v2015 A1");
  EXPECT_EQ(make("hid:A2")->info().name, "woodenhaptics_v2015 A2");
  EXPECT_EQ(make("hid:/dev/hidraw4,model=polhem_v1")->info().name, "polhem_v1 A2");
  EXPECT_EQ(refusalOf("hid:A3"), "device hid:A3: not connected; there is: A1, A2");
  EXPECT_TRUE(holds(refusalOf("hid,model=omni"), "woodenhaptics_v2015, woodenhaptics_v2019"));
  EXPECT_TRUE(holds(refusalOf("hid,calibrate=now"), "no, start"));
  EXPECT_THROW(make("hid,colour=red"), FaultError);
  fakeHids().list[0].descriptor = vendorPage(8);
  EXPECT_TRUE(holds(refusalOf("hid"), "device hid: its firmware is too old: it sends reports of 8 bytes"));
}

// A force to the right at the angles of no counts: what the motors are told is held to the largest current, 2 A unless it is told.
TEST_F(HidDevices, AnArmsCurrentIsHeldToTwoAmperesUnlessItIsTold) {
  test::resetFakeHids({teensy()});
  const auto most = [&](const std::string& spec) {
    int largest = 0;
    const auto device = make(spec);
    until([&] {
      device->write({1000, 1000, 1000});
      const auto all = written();
      if (all.size() < 20) return false;
      largest = std::max(largest, largestCurrent(all.back()));
      return largest > 0;
    });
    return largest;
  };
  EXPECT_EQ(most("hid"), 2000);
  fakeHids().list[0].written.clear();
  EXPECT_EQ(most("hid,max-current=0.5"), 500);
}

TEST_F(HidDevices, AnArmThatComesBackIsTakenUpAgainByItsName) {
  test::resetFakeHids({teensy()});
  const auto device = make("hid:A1");
  ASSERT_TRUE(until([&] { return device->read().reports > 3; }));
  test::setFirstFakeHid(true);
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  test::setFirstFakeHid(false);
  EXPECT_TRUE(until([&] { return device->read().valid; }));
  EXPECT_EQ(fakeHids().list[0].opened, 2);
}

TEST_F(HidDevices, ASpaceMouseIsKnownByItsVendorAndTheOlderOnesByTheirProduct) {
  EXPECT_EQ(rows("spacemouse").at(0).whyNot, "no 3Dconnexion SpaceMouse (USB 256f, 046d:c6xx) is connected");
  EXPECT_FALSE(rows("spacemouse").at(0).present);
  const auto isOne = [&](std::uint16_t vendor, std::uint16_t product) {
    test::resetFakeHids({spaceMouse(vendor, product)});
    return rows("spacemouse").at(0).present;
  };
  EXPECT_TRUE(isOne(0x256F, 1));
  for (const int product : {0xC603, 0xC605, 0xC606, 0xC621, 0xC623, 0xC625, 0xC626, 0xC627, 0xC628, 0xC629, 0xC62B})
    EXPECT_TRUE(isOne(0x046D, static_cast<std::uint16_t>(product))) << product;
  EXPECT_FALSE(isOne(0x046D, 0xC604));
  EXPECT_FALSE(isOne(0x046E, 0xC603));
  EXPECT_FALSE(isOne(0x256E, 0xC635));
  test::resetFakeHids({spaceMouse()});
  const FoundDevice row = rows("spacemouse").at(0);
  EXPECT_EQ(row.name, "spacemouse:/dev/hidraw5");
  EXPECT_EQ(row.description, "SpaceMouse Compact");
  EXPECT_EQ(row.degreesOfFreedom, 6);
  EXPECT_EQ(row.rate, 125);
  EXPECT_EQ(row.maxForce, 0);
  fakeHids().list[0].closedBy = EACCES;
  EXPECT_FALSE(rows("spacemouse").at(0).present);
}

TEST_F(HidDevices, ASpaceMousesPushIsTheHandsSpeed) {
  EXPECT_EQ(refusalOf("spacemouse:X"), "device spacemouse:X: no such 3Dconnexion SpaceMouse is connected");
  FakeHid half = spaceMouse();
  half.steady = {1, 0xAF, 0, 0, 0, 0, 0};  // half a push
  test::resetFakeHids({half});
  const auto speed = [&](const std::string& spec) {
    const auto hand = make(spec);
    double x = 0;
    until([&] { return (x = hand->read().velocity.x) > 0; });
    return x;
  };
  EXPECT_NEAR(speed("spacemouse"), 0.5 * (0.5 - 0.05) / 0.95, 1e-12);
  EXPECT_NEAR(speed("spacemouse:/dev/hidraw5,gain=2,dead-zone=0.2"), 2 * (0.5 - 0.2) / 0.8, 1e-12);
  const haptics::DeviceInfo info = make("spacemouse")->info();
  EXPECT_EQ(info.name, "SpaceMouse Compact");
  EXPECT_EQ(info.version, "HID");
  EXPECT_EQ(info.rate, 125);
  fakeHids().list[0].title.clear();
  EXPECT_EQ(make("spacemouse")->info().name, "SpaceMouse");
  for (const char* good : {"gain=0.01", "gain=5", "dead-zone=0", "dead-zone=0.5"})
    EXPECT_EQ(refusalOf(std::string("spacemouse,") + good), "made");
  for (const char* bad : {"gain=0.0099", "gain=5.1", "dead-zone=-0.1", "dead-zone=0.51", "travel=1"})
    EXPECT_THROW(make(std::string("spacemouse,") + bad), FaultError) << bad;
}

TEST_F(HidDevices, AnUnpluggedSpaceMouseIsLostAndComesBackWithoutItsPush) {
  FakeHid mouse = spaceMouse();
  mouse.steady.clear();
  mouse.reports = {{1, 0x5E, 0x01, 0, 0, 0, 0}};
  test::resetFakeHids({mouse});
  const auto hand = make("spacemouse");
  ASSERT_TRUE(until([&] { return hand->read().velocity.x > 0; }));
  test::setFirstFakeHid(true);
  ASSERT_TRUE(until([&] { return !hand->read().valid; }));
  EXPECT_EQ(hand->health(), haptics::DeviceHealth::Lost);
  test::setFirstFakeHid(false, {{3, 1}});  // a button, no push
  EXPECT_TRUE(until([&] { return hand->read().valid; }));
  EXPECT_TRUE(until([&] { return hand->read().buttons == 1; }));
  EXPECT_EQ(hand->read().velocity.x, 0);
}

// All that waits is taken at once, and only the first is waited for.
TEST_F(HidDevices, ASpaceMousesNewestPushCounts) {
  FakeHid mouse = spaceMouse();
  mouse.steady.clear();
  for (int i = 0; i < 200; ++i) mouse.reports.push_back({1, static_cast<std::uint8_t>(i), 0, 0, 0, 0, 0});
  test::resetFakeHids({mouse});
  const auto hand = make("spacemouse,dead-zone=0,gain=1");
  double first = 0;
  ASSERT_TRUE(until([&] { return (first = hand->read().velocity.x) > 0; }));
  EXPECT_NEAR(first, 199 / 350.0, 1e-12);
  const std::lock_guard lock(fakeHids().mutex);
  const std::vector<int>& waits = fakeHids().list[0].waits;
  ASSERT_GT(waits.size(), 200u);
  EXPECT_EQ(waits[0], 50);
  EXPECT_EQ(std::count(waits.begin() + 1, waits.begin() + 201, 0), 200);
}

TEST_F(HidDevices, WhatIsPluggedInIsFoundAsFarAsItIsPresent) {
  FakeHid closed = teensy("/dev/hidraw9", L"C");
  closed.closedBy = EACCES;
  test::resetFakeHids({teensy(), closed, spaceMouse()});
  std::vector<std::string> names;
  for (const FoundDevice& device : findPlugged()) names.push_back(device.name);
  EXPECT_EQ(names, (std::vector<std::string>{"hid:A1", "spacemouse:/dev/hidraw5"}));
}

}  // namespace
}  // namespace reachlab::devices
