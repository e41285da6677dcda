#include "devices/serial/polhem_device.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <random>
#include <thread>

#include "base/error.h"
#include "cli/bench/allocation_count.h"
#include "devices/make_device.h"
#include "devices/serial/polhem_line.h"
#include "devices/serial/serial_port.h"
#include "sim/experiment/experiment.h"
#include "tests/devices/fakes/fake_message_line.h"
#include "tests/devices/fakes/pseudo_terminal.h"
#include "tests/refusal.h"
#include "tests/until.h"

namespace {
int settingFault = 0;  // errno of every tcsetattr; 0: the system answers
}
extern "C" {
int __real_tcsetattr(int file, int when, const termios* settings);
int __wrap_tcsetattr(int file, int when, const termios* settings) {
  if (settingFault == 0) return __real_tcsetattr(file, when, settings);
  errno = settingFault;
  return -1;
}
}

namespace reachlab::devices {
namespace {

using test::until;

/// The arm's firmware at the other end of a serial line: answers each line of 64 bytes by its place. It has no watchdog, so that a force is
/// taken back by the program alone.
class Firmware {
 public:
  Vec3 force() const {  // [N], its own axes
    const std::lock_guard lock(mutex_);
    return force_;
  }

  const test::PseudoTerminal line;
  std::atomic<bool> silent{false};

 private:
  void run(const std::stop_token& stop) {
    std::string heard;
    while (!stop.stop_requested()) {
      pollfd at{line.wire, POLLIN, 0};
      if (::poll(&at, 1, 2) > 0 && (at.revents & POLLIN) != 0) {
        char bytes[256];
        const ssize_t got = ::read(line.wire, bytes, sizeof bytes);
        if (got > 0) heard.append(bytes, static_cast<std::size_t>(got));
      }
      if (heard.size() >= kPolhemLineBytes) {
        take(heard.substr(0, kPolhemLineBytes));
        heard.erase(0, kPolhemLineBytes);
      }
    }
  }
  void take(const std::string& heard) {
    short fx = 0, fy = 0, fz = 0, command = 0;
    if (heard.back() != '\n' || std::sscanf(heard.c_str(), "%hd %hd %hd %hd", &fx, &fy, &fz, &command) != 4 || command != 2) return;
    {
      const std::lock_guard lock(mutex_);
      force_ = 1e-3 * Vec3{static_cast<double>(fx), static_cast<double>(fy), static_cast<double>(fz)};
    }
    if (silent) return;
    std::string answer = "  25.000  -10.000   40.000  0.0000  0.0000  0.0000  0.0000 0";
    answer.resize(kPolhemLineBytes - 1, ' ');
    answer += '\n';
    (void)!::write(line.wire, answer.data(), answer.size());
  }

  mutable std::mutex mutex_;
  Vec3 force_;
  std::jthread thread_{[this](const std::stop_token& stop) { run(stop); }};
};

std::unique_ptr<haptics::HapticDevice> openPolhem(const Firmware& firmware) {
  return makeDevice("polhem:" + firmware.line.path, experiment::readExperiment("chain-slow"), 1);
}

TEST(PolhemLine, PlacesAreReadInMetresAndGarbageIsNot) {
  const auto state = readPolhemLine("  25.000  -10.500   40.000  0.1000 -0.2000  0.0000  0.0000 -8     ");
  ASSERT_TRUE(state.has_value());
  EXPECT_LT(norm(state->place - Vec3{0.025, -0.0105, 0.04}), 1e-15);
  EXPECT_EQ(state->info, -8);
  for (const char* line : {"1000 0 0 0 0 0 0 0", "0 0 0 0 0 0 0 1000000", "1 2 3 4 5 6 7 8\r", "   1 2 3 4 5 6 7 8 \r "})
    EXPECT_TRUE(readPolhemLine(line).has_value()) << line;
  for (const char* line : {"", "   ", "1 2 3", "1 2 3 4 5 6 7", "1 2 3 4 5 6 7 8 9", "a b c d e f g h", "nan 0 0 0 0 0 0 0",
                           "1e9 0 0 0 0 0 0 0", "1,5 0 0 0 0 0 0 0", "1000.1 0 0 0 0 0 0 0", "-800 -800 0 0 0 0 0 0",
                           "0 0 0 0 0 0 0 1000001", "0 0 0 0 0 0 0 -1000001", "1 2 3 4 5 6 7 8x", "1 2 3x 4 5 6 7 8", "1 2 3 inf 5 6 7 8"})
    EXPECT_FALSE(readPolhemLine(line).has_value()) << line;
}

TEST(PolhemLine, ForcesAreWholeMillinewtonsOfSixteenBitsWithTheirDirection) {
  EXPECT_EQ(polhemForceLine({-1, 2, 0.0006}), "-1000 2000 1 2 0 0 0" + std::string(43, ' ') + "\n");
  EXPECT_EQ(polhemForceLine({0, 0, 32.767}).substr(0, 10), "0 0 32767 ");
  EXPECT_EQ(polhemForceLine({0, -60, 80}).substr(0, 14), "0 -19660 26214") << "0.6 and 0.8 of 32767";
  for (const double none : {NAN, INFINITY}) EXPECT_EQ(polhemForceLine({none, 1, 1}), polhemForceLine({}));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-100, 100);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 force{any(random), any(random), any(random)};
    int x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(polhemForceLine(force).c_str(), "%d %d %d", &x, &y, &z), 3);
    const Vec3 told{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
    ASSERT_LE(norm(told), 32768);
    ASSERT_GT(dot(told, force), (1 - 1e-3) * norm(told) * norm(force)) << "rounding to a millinewton turns it that little";
  }
}

class PolhemOverAWire : public ::testing::Test {
 protected:
  PolhemOverAWire() { wish.force = {1, 2, 3}; }
  static std::string placeAt(int x, int info = 0) { return std::to_string(x) + " 20 30 0 0 0 0 " + std::to_string(info); }
  Exchange turn() { return arm.exchange(wish, sample); }
  std::shared_ptr<test::FakeMessageLine> line = std::make_shared<test::FakeMessageLine>();
  test::FakeMessageLine& wire = *line;
  test::StandingForce wish;
  haptics::DeviceSample sample;
  PolhemSerial arm{"Polhem", [this]() -> std::unique_ptr<MessageLink> {
                     if (wire.closed) throw ResourceError("no line");
                     return std::make_unique<test::FakeMessageLink>(line);
                   }};
};

TEST_F(PolhemOverAWire, IsAskedOnceAndAgainAfterTenMilliseconds) {
  EXPECT_EQ(turn(), Exchange::Nothing);
  EXPECT_EQ(wire.sent, std::vector<std::string>{polhemForceLine({3, 1, 2})});
  EXPECT_EQ(wire.waits, std::vector<int>{10});
  wish.ns = 10'000'000;
  turn();
  EXPECT_EQ(wire.sent.size(), 1u);
  wish.ns += 1;
  turn();
  EXPECT_EQ(wire.sent.size(), 2u);
  wish.ns += 10'000'000;
  turn();
  EXPECT_EQ(wire.sent.size(), 2u);
  wire.waiting = {placeAt(1), placeAt(10, 7)};
  EXPECT_EQ(turn(), Exchange::Report);
  EXPECT_LT(norm(sample.position - Vec3{0.02, 0.03, 0.01}), 1e-15) << "the newest";
  EXPECT_EQ(sample.buttons, 1u);
  EXPECT_FALSE(sample.hasVelocity);
  wire.waiting = {placeAt(1)};
  turn();
  EXPECT_EQ(sample.buttons, 0u);
  EXPECT_EQ(wire.sent.size(), 3u) << "answered it is told at once";
}

TEST_F(PolhemOverAWire, UpToSixtyFourLinesMoreAreTakenAtATime) {
  for (int i = 0; i < 70; ++i) wire.waiting.push_back(placeAt(i));
  EXPECT_EQ(turn(), Exchange::Report);
  EXPECT_NEAR(sample.position.z, 0.064, 1e-15);
  EXPECT_EQ(wire.waits[1], 0);
}

TEST_F(PolhemOverAWire, FiftyTurnsWithoutAPlaceAreALoss) {
  for (int i = 0; i < 49; ++i) EXPECT_EQ(turn(), Exchange::Nothing);
  wire.waiting = {placeAt(1)};
  EXPECT_EQ(turn(), Exchange::Report);
  for (int i = 0; i < 49; ++i) {
    wire.waiting = {"?"};
    EXPECT_EQ(turn(), Exchange::Nothing);
  }
  EXPECT_EQ(turn(), Exchange::Lost);
  ASSERT_TRUE(arm.reopen());
  const std::size_t sent = wire.sent.size();
  for (int i = 0; i < 49; ++i) EXPECT_EQ(turn(), Exchange::Nothing) << "opened again it begins anew";
  EXPECT_GT(wire.sent.size(), sent) << "and is told at once";
}

TEST_F(PolhemOverAWire, GoneOrDeafItIsLostAndToldZeroAsLongAsItIsOpen) {
  wire.gone = true;
  EXPECT_EQ(turn(), Exchange::Lost);
  wire.gone = false;
  ASSERT_TRUE(arm.reopen());
  wire.deaf = true;
  EXPECT_EQ(turn(), Exchange::Lost);
  EXPECT_FALSE(arm.tellZero());
  wire.deaf = false;
  EXPECT_TRUE(arm.tellZero());
  EXPECT_EQ(wire.sent.back(), polhemForceLine({}));
  wire.closed = true;
  EXPECT_THROW(arm.reopen(), ResourceError);
  EXPECT_EQ(turn(), Exchange::Lost);
  wire.deaf = true;
  EXPECT_TRUE(arm.tellZero()) << "nobody is there to be told";
  wire.closed = wire.deaf = false;
  ASSERT_TRUE(arm.reopen());
  wire.sent.clear();
  arm.close();
  EXPECT_EQ(wire.sent, std::vector<std::string>{polhemForceLine({})});
  EXPECT_EQ(turn(), Exchange::Lost);
}

/// The line at the one end of a pseudo-terminal.
class SerialLine : public ::testing::Test {
 protected:
  void put(const std::string& text) const {
    ASSERT_EQ(::write(terminal.wire, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string next(int milliseconds = 1000) {
    std::string message;
    return line->receive(message, milliseconds) == MessageLink::Got::Message ? message : "nothing";
  }
  test::PseudoTerminal terminal;
  std::unique_ptr<MessageLink> line = openSerial(terminal.path);
};

TEST_F(SerialLine, GivesWholeLinesInTheirOrder) {
  EXPECT_EQ(next(0), "nothing");
  put("one\ntwo\nthr");
  EXPECT_EQ(next(), "one");
  EXPECT_EQ(next(0), "two");
  EXPECT_EQ(next(0), "nothing");
  put("ee\n\n");
  EXPECT_EQ(next(), "three");
  EXPECT_EQ(next(), "");
}

TEST_F(SerialLine, WhatIsLongerThanALineCanBeIsThrownAway) {
  put(std::string(200, 'a'));
  EXPECT_EQ(next(), "nothing");
  put(std::string(56, 'b') + "\n");
  EXPECT_EQ(next().size(), 256u) << "as long as a line can be";
  put(std::string(200, 'a'));
  EXPECT_EQ(next(), "nothing");
  put(std::string(57, 'b'));
  EXPECT_EQ(next(), "nothing");
  EXPECT_EQ(next(0), "nothing");
  put("after\n");
  EXPECT_EQ(next(), "after");
}

// It runs beside the tick, and what it is declared not to throw it could not tell.
TEST_F(SerialLine, IsReadWithoutAskingForMemory) {
  std::string message(2 * kLongestLine, ' ');
  for (int i = 0; i < 100; ++i) {
    put(std::string(200, 'a') + "\n" + std::string(50, 'b') + "\n");
    const std::uint64_t before = cli::countAllocations();
    EXPECT_EQ(line->receive(message, 1000), MessageLink::Got::Message);
    EXPECT_EQ(line->receive(message, 1000), MessageLink::Got::Message);
    EXPECT_EQ(cli::countAllocations(), before);
    EXPECT_EQ(message, std::string(50, 'b'));
  }
}

TEST_F(SerialLine, OneThatCannotBeSetUpIsRefused) {
  line.reset();
  settingFault = EIO;
  EXPECT_EQ(refusalOf([&] { openSerial(terminal.path); }), terminal.path + ": cannot be set to 115200 baud, raw: Input/output error");
  settingFault = 0;
}

// Two hands or two programs would tell one arm two forces.
TEST_F(SerialLine, IsHeldByOneAlone) {
  EXPECT_TRUE(holds(refusalOf([&] { openSerial(terminal.path); }), terminal.path + ": is already in use"));
  line.reset();
  EXPECT_NE(openSerial(terminal.path), nullptr);
}

TEST_F(SerialLine, SendsAsItIsAndIsGoneWithItsOtherEnd) {
  EXPECT_TRUE(line->send("a\r\n\x03 b"));
  char heard[32];
  ASSERT_EQ(::read(terminal.wire, heard, sizeof heard), 6);
  EXPECT_EQ(std::string(heard, 6), "a\r\n\x03 b") << "raw";
  // Nobody reads: what fits in is taken, and then no more within 20 ms.
  const std::string much(1 << 16, 'x');
  EXPECT_FALSE(line->send(much));
  EXPECT_EQ(line->fault(), "Connection timed out");
  terminal.cut();
  std::string message;
  EXPECT_EQ(line->receive(message, 1000), MessageLink::Got::Gone);
  EXPECT_FALSE(line->send("x"));
  EXPECT_EQ(line->fault(), "Input/output error");
}

TEST(Polhem, GivesItsPlaceAndGetsItsForce) {
  Firmware firmware;
  const auto device = openPolhem(firmware);
  ASSERT_TRUE(until([&] { return norm(device->read().position - Vec3{-0.01, 0.04, 0.025}) < 1e-12; }));
  ASSERT_TRUE(until([&] {
    device->write({1, 2, 3});
    return firmware.force() == Vec3{3, 1, 2};
  }));
  EXPECT_TRUE(until([&] { return firmware.force() == Vec3{}; })) << "a force that is not renewed is taken back";
}

TEST(Polhem, AnArmThatNeverReportsIsRefusedAndNamedADeviceOnce) {
  Firmware firmware;
  firmware.silent = true;
  const std::string said = refusalOf<ResourceError>([&] { openPolhem(firmware); });
  EXPECT_TRUE(said.starts_with("device polhem:" + firmware.line.path + ": ")) << said;
  EXPECT_EQ(said.find("device ", 1), std::string::npos) << said;
  EXPECT_TRUE(holds(said, "no report came within 2000 ms"));
}

TEST(Polhem, WhatIsNoSerialLineIsRefusedInTheSystemsWords) {
  const auto experiment = experiment::readExperiment("chain-slow");
  EXPECT_THROW(makeDevice("polhem:/dev/null", experiment, 1), ResourceError);
  EXPECT_TRUE(holds(refusalOf([&] { makeDevice("polhem:/dev/ttyNowhere", experiment, 1); }), "No such file"));
}

}  // namespace
}  // namespace reachlab::devices
