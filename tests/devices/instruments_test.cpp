#include "devices/instruments/instruments.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/ppdev.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <thread>

#include "base/error.h"
#include "base/os.h"
#include "devices/instruments/lab_streaming.h"
#include "devices/instruments/trigger_lines.h"
#include "tests/devices/fakes/fake_lsl.h"
#include "tests/until.h"
#include "tests/record/made_run.h"

namespace reachlab::devices {
namespace {

/// A port as the kernel would show it, at the lowest place: every call is seen with its bytes.
struct FakePort {
  std::string opened;
  std::vector<std::pair<unsigned long, int>> controls;  // request and the byte or lines it was given
  int interrupts = 0;                                   // EINTR so many times
  int error = 0;                                        // errno of every further control
  int lines = 0, status = 0x78;
  bool closed = false;
};
FakePort port;

const PortCalls kFakeCalls{
    [](const char* path, int) {
      port.opened = path;
      if (std::string(path) != "/dev/missing") return 7;
      errno = ENOENT;
      return -1;
    },
    [](int) {
      port.closed = true;
      return 0;
    },
    [](int, unsigned long request, void* argument) {
      if (port.interrupts-- > 0) return errno = EINTR, -1;
      if (port.error != 0) return errno = port.error, -1;
      int given = 0;
      if (request == PPWDATA) given = *static_cast<unsigned char*>(argument);
      if (request == TIOCMBIS || request == TIOCMBIC) {
        given = *static_cast<int*>(argument);
        port.lines = request == TIOCMBIS ? port.lines | given : port.lines & ~given;
      }
      if (request == PPRSTATUS) *static_cast<unsigned char*>(argument) = static_cast<unsigned char>(port.status);
      if (request == TIOCMGET) *static_cast<int*>(argument) = port.lines;
      if (request != PPRSTATUS && request != TIOCMGET) port.controls.emplace_back(request, given);
      return 0;
    },
    [](int, const void*, std::size_t) { return -1L; },
    [](int, void*, std::size_t) { return 0L; },
};

class Triggers : public testing::Test {
 protected:
  void SetUp() override { port = {}; }
  std::vector<InstrumentNote> notes_;
};

using Controls = std::vector<std::pair<unsigned long, int>>;

TEST_F(Triggers, AParallelPortHoldsTheCodeForAPulse) {
  {
    const auto lines = openParallelPort("parallel", "/dev/parport0", {{1, 0, 4}, 0.005}, kFakeCalls);
    EXPECT_EQ(port.opened, "/dev/parport0");
    EXPECT_EQ(port.controls, (Controls{{PPCLAIM, 0}, {PPWDATA, 0}}));
    EXPECT_TRUE(lines->send({Mark::Go, 1, os::now()}));
    EXPECT_FALSE(lines->send({Mark::Onset, 1, os::now()})) << "0 is not sent";
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 1}));
    lines->look(os::now() + 1'000'000, notes_);
    EXPECT_EQ(port.controls.back().second, 1) << "the pulse lasts";
    lines->look(os::now() + 6'000'000, notes_);
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 0}));
    EXPECT_TRUE(lines->send({Mark::Success, 1, os::now()}));
    lines->end(notes_);
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 0})) << "no line stays up";
  }
  EXPECT_EQ(port.controls.back().first, PPRELEASE);
  EXPECT_TRUE(port.closed);
}

TEST_F(Triggers, AChangeOfAnInputIsNotedOnce) {
  const auto lines = openParallelPort("parallel", "/dev/parport0", {}, kFakeCalls);
  lines->look(1, notes_);
  lines->look(2, notes_);
  EXPECT_TRUE(notes_.empty());
  port.status = 0x38;
  lines->look(3, notes_);
  lines->look(4, notes_);
  ASSERT_EQ(notes_.size(), 1u);
  EXPECT_EQ(notes_[0].ns, 3);
  EXPECT_EQ(notes_[0].value, 0x38);
}

TEST_F(Triggers, ASerialPortsLineGoesUpAndDown) {
  port.lines = TIOCM_RTS;  // whoever had it before
  const auto lines = openSerialLines("rts", "/dev/ttyS0", {}, kFakeCalls);
  EXPECT_EQ(port.lines & TIOCM_RTS, 0);
  lines->send({Mark::Go, 1, os::now()});
  EXPECT_NE(port.lines & TIOCM_RTS, 0);
  lines->look(os::now() + 10'000'000, notes_);
  EXPECT_EQ(port.lines & TIOCM_RTS, 0);
  port.lines |= TIOCM_CTS;
  lines->look(5, notes_);
  port.lines |= TIOCM_DSR;
  lines->look(6, notes_);
  ASSERT_EQ(notes_.size(), 2u);
  EXPECT_EQ(notes_[0].value, 1);
  EXPECT_EQ(notes_[1].value, 3);
}

TEST_F(Triggers, AnInterruptedCallIsMadeAgainAndAFaultIsTold) {
  port.interrupts = 3;
  const auto lines = openParallelPort("parallel", "/dev/parport0", {}, kFakeCalls);
  EXPECT_EQ(port.controls.front().first, PPCLAIM);
  port.error = EIO;
  try {
    lines->send({Mark::Go, 1, 0});
    FAIL();
  } catch (const ResourceError& error) {
    EXPECT_STREQ(error.what(), "/dev/parport0: Input/output error");
  }
  EXPECT_THROW(openParallelPort("parallel", "/dev/missing", {}, kFakeCalls), ResourceError);
}

// Ticks of a made run, one a millisecond where the instruments are to keep up in real time.
void play(record::InstrumentLink& link, int trials, bool inRealTime) {
  record::MadeRun run;
  const auto ticks = static_cast<std::uint64_t>(trials) * record::MadeRun::kTicksPerTrial;
  const std::int64_t begin = os::now();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    if (tick % record::MadeRun::kTicksPerTrial == 0) {
      const int trial = static_cast<int>(tick / record::MadeRun::kTicksPerTrial) + 1;
      link.announce(trial, {trial - 1, 5, false});
    }
    if (inRealTime) os::sleepUntil(begin + static_cast<std::int64_t>(tick) * 1'000'000);
    haptics::TickState state = run.next();
    state.measuredNs = os::now();
    EXPECT_TRUE(link.onTick(state, trial::Command::None, 0));
  }
}

std::vector<record::RecordedEvent> eventsOf(record::InstrumentLink& link, int trials, bool inRealTime = false) {
  link.begin(record::madeConfiguration());
  play(link, trials, inRealTime);
  link.close();
  return link.takeEvents();
}

// The trial of a made run: armed at 20 ms, go 5 ms later, onset at 50 ms, end at 250 ms; even trials fail.
TEST_F(Triggers, WhatHappenedIsFoundAtTheTicksThatTheRecordingHasItAt) {
  std::vector<std::unique_ptr<Instrument>> instruments;
  instruments.push_back(openParallelPort("parallel", "/dev/parport0", {}, kFakeCalls));
  const auto link = linkInstruments(std::move(instruments));
  EXPECT_EQ(link->names(), "parallel");
  const auto events = eventsOf(*link, 2);
  std::vector<std::pair<std::uint64_t, std::string>> found;
  for (const record::RecordedEvent& event : events) {
    EXPECT_EQ(event.kind, record::EventKind::Instrument);
    EXPECT_GT(event.value, 0) << "sent after its tick";
    found.emplace_back(event.tick, event.text);
  }
  EXPECT_EQ(found, (std::vector<std::pair<std::uint64_t, std::string>>{{25, "parallel out go"},
                                                                       {50, "parallel out onset"},
                                                                       {250, "parallel out success"},
                                                                       {300, "parallel out go"},
                                                                       {325, "parallel out onset"}}));
  EXPECT_EQ(events.back().trial, 2);
  EXPECT_TRUE(link->takeWarnings().empty());
}

TEST_F(Triggers, AnInstrumentThatFailsIsLeftOutWithAWord) {
  std::vector<std::unique_ptr<Instrument>> instruments;
  instruments.push_back(openParallelPort("first", "/dev/parport0", {}, kFakeCalls));
  const auto link = linkInstruments(std::move(instruments));
  port.error = EIO;
  const auto events = eventsOf(*link, 2);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].text, "first lost: /dev/parport0: Input/output error");
  const auto warnings = link->takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "instrument first is lost: /dev/parport0: Input/output error; what follows is recorded without it");
}

// Bytes through a pseudo-terminal. What the offsets are on this machine is printed; they are judged only against being none or nonsense.
TEST_F(Triggers, BytesComeOutOfALineAndGoIn) {
  int wire = -1, slave = -1;
  char name[128] = {};
  ASSERT_EQ(::openpty(&wire, &slave, name, nullptr, nullptr), 0);
  ::fcntl(wire, F_SETFL, O_NONBLOCK);
  struct Arrival {
    std::int64_t ns;
    int byte;
  };
  std::vector<Arrival> arrived;
  std::atomic<int> count{0};
  std::vector<record::RecordedEvent> events;
  std::vector<std::unique_ptr<Instrument>> instruments;
  instruments.push_back(openByteLine("box", name, {{1, 2, 4}, 0}, 115200));
  const auto link = linkInstruments(std::move(instruments));
  {
    std::jthread box([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        unsigned char byte = 0;
        if (::read(wire, &byte, 1) != 1) {
          os::sleepUntil(os::now() + 50'000);
          continue;
        }
        arrived.push_back({os::now(), byte});
        ++count;
        if (byte == 2 && ::write(wire, "\xfe", 1) != 1) ADD_FAILURE();  // the box answers an onset
      }
    });
    events = eventsOf(*link, 3, true);
    test::until([&] { return count >= 8; });
  }
  std::vector<int> bytes;
  for (const Arrival& arrival : arrived) bytes.push_back(arrival.byte);
  EXPECT_EQ(bytes, (std::vector<int>{1, 2, 4, 1, 2, 1, 2, 4}));
  std::vector<double> offsets;
  int answers = 0;
  for (const record::RecordedEvent& event : events) {
    if (event.text.starts_with("box in at ")) {
      EXPECT_EQ(event.value, 0xfe);
      ++answers;
    } else {
      EXPECT_GT(event.value, 0);
      offsets.push_back(event.value);
    }
  }
  EXPECT_EQ(answers, 3);
  ASSERT_EQ(offsets.size(), 8u);
  std::sort(offsets.begin(), offsets.end());
  std::printf("from a tick's clock to its byte's leaving: median %.0f us, longest %.0f us of %zu\n", 1e6 * offsets[4], 1e6 * offsets.back(),
              offsets.size());
  ::close(wire);
  ::close(slave);
}

class LabStreamingLayer : public testing::Test {
 protected:
  void SetUp() override { test::resetFakeLsl(); }
};

TEST_F(LabStreamingLayer, MarkersAndTheHandGoOutUnderTheTicksOwnTimes) {
  std::vector<std::unique_ptr<Instrument>> instruments;
  instruments.push_back(openLabStreaming("lsl"));
  const auto link = linkInstruments(std::move(instruments));
  const auto events = eventsOf(*link, 2);
  const test::FakeLsl& lsl = test::fakeLsl();
  ASSERT_EQ(lsl.streams.size(), 2u);
  const auto& markers = lsl.streams[0];
  EXPECT_EQ(markers.name, "reachlab-markers");
  EXPECT_EQ(markers.type, "Markers");
  EXPECT_EQ(markers.format, 3) << "text";
  EXPECT_EQ(markers.rate, 0) << "irregular";
  EXPECT_NE(markers.clock.find("monotonic"), std::string::npos) << markers.clock;
  const auto& hand = lsl.streams[1];
  EXPECT_EQ(hand.type, "MoCap");
  EXPECT_EQ(hand.rate, 1000);
  EXPECT_EQ(hand.labels, (std::vector<std::string>{"hand_x", "hand_y", "hand_z", "hand_vx", "hand_vy", "hand_vz"}));
  ASSERT_EQ(hand.numbers.size(), 2 * record::MadeRun::kTicksPerTrial);
  std::vector<std::string> texts;
  for (const auto& [time, text] : markers.texts) texts.push_back(text);
  EXPECT_EQ(texts, (std::vector<std::string>{"go 1", "onset 1", "success 1", "go 2", "onset 2"}));
  // A marker has the very time of the sample that it belongs to.
  EXPECT_EQ(markers.texts[0].first, hand.numbers[25].first);
  EXPECT_EQ(markers.texts[1].first, hand.numbers[50].first);
  EXPECT_EQ(hand.numbers[60].second[0], record::MadeRun::valueAt(60));
  // The offset is known to the tightness of two readings of the clock; a machine that stops between them is not our fault.
  double offset = 0;
  int clocks = 0;
  for (const record::RecordedEvent& event : events)
    if (event.text.starts_with("lsl clock less CLOCK_MONOTONIC [s]")) offset = event.value, ++clocks;
  EXPECT_EQ(clocks, 2) << "at begin and end";
  EXPECT_NEAR(offset, lsl.clockAhead, 1e-3);
}

TEST_F(LabStreamingLayer, GivesBackWhatItTook) {
  {
    std::vector<std::unique_ptr<Instrument>> instruments;
    instruments.push_back(openLabStreaming("lsl"));
    const auto link = linkInstruments(std::move(instruments));
    (void)eventsOf(*link, 1);
    (void)eventsOf(*link, 1);
    EXPECT_EQ(test::fakeLsl().streams.size(), 4u) << "streams of their own for each run";
    EXPECT_EQ(test::fakeLsl().alive, 4);
  }
  EXPECT_EQ(test::fakeLsl().alive, 0);
}

TEST_F(LabStreamingLayer, ThatTakesNothingAnyMoreIsLeftOut) {
  test::fakeLsl().takesNothing = true;
  std::vector<std::unique_ptr<Instrument>> instruments;
  instruments.push_back(openLabStreaming("lsl"));
  const auto link = linkInstruments(std::move(instruments));
  (void)eventsOf(*link, 1);
  const auto warnings = link->takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "instrument lsl is lost: liblsl: takes no sample any more; what follows is recorded without it");
}

TEST(OpenInstruments, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(openInstruments({}), nullptr);
  const auto refusalOf = [](const std::string& spec) {
    try {
      (void)openInstruments({spec});
      return std::string("opened");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_EQ(refusalOf("trumpet"), "instrument: is trumpet, which is unknown; allowed: lsl, parallel:PATH, rts:PATH, byte:PATH");
  EXPECT_EQ(refusalOf("rts"), "instrument: rts: its port is missing; allowed: rts:/dev/…");
  EXPECT_NE(refusalOf("byte:/dev/null,go=256").find("go=256; allowed: a number from 0 to 255"), std::string::npos);
  EXPECT_NE(refusalOf("byte:/dev/null,pulse-ms=5").find("pulse-ms is not known"), std::string::npos) << "a byte has no length";
  EXPECT_NE(refusalOf("byte:/dev/no-such-line").find("/dev/no-such-line: No such file or directory"), std::string::npos);
  EXPECT_NE(refusalOf("byte:/dev/null").find("/dev/null: Inappropriate ioctl for device"), std::string::npos);
}

}  // namespace
}  // namespace reachlab::devices
