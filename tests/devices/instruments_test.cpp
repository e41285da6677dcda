#include "devices/instruments/instruments.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/ppdev.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>

#include "base/error.h"
#include "base/system/os.h"
#include "devices/instruments/lab_streaming.h"
#include "devices/instruments/trigger_lines.h"
#include "tests/devices/fakes/fake_lsl.h"
#include "tests/devices/fakes/pseudo_terminal.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

/// A port as the kernel would show it, at the lowest place: every call is seen with its bytes.
struct FakePort {
  std::string opened;
  int flags = 0, openError = 0, closes = 0;
  std::vector<std::pair<unsigned long, int>> controls;  // request and the byte or lines it was given
  int interrupts = 0;                                   // EINTR so many times
  int error = 0;                                        // errno of every further control, writing and reading
  int lines = 0, status = 0x78;
  std::vector<unsigned char> written, waiting;
};
FakePort port;

template <class Answer>
Answer answered(Answer good) {
  errno = port.interrupts-- > 0 ? EINTR : port.error;
  return errno == 0 ? good : Answer{-1};
}

const PortCalls kFakeCalls{
    [](const char* path, int flags) {
      port.opened = path;
      port.flags = flags;
      errno = port.openError;
      return errno == 0 ? 0 : -1;  // any descriptor, even this one
    },
    [](int) { return ++port.closes; },
    [](int, unsigned long request, void* argument) {
      if (answered(0) < 0) return -1;
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
    [](int, const void* bytes, std::size_t count) {
      const long sent = answered(static_cast<long>(count));
      if (sent > 0) port.written.push_back(*static_cast<const unsigned char*>(bytes));
      return sent;
    },
    [](int, void* bytes, std::size_t count) {
      const std::size_t there = std::min(count, port.waiting.size());
      if (answered(0) < 0) return -1L;
      std::copy_n(port.waiting.begin(), there, static_cast<unsigned char*>(bytes));
      port.waiting.erase(port.waiting.begin(), port.waiting.begin() + static_cast<std::ptrdiff_t>(there));
      return static_cast<long>(there);
    },
};

template <class... Instruments>
std::unique_ptr<record::InstrumentLink> linked(Instruments... one) {
  std::vector<std::unique_ptr<Instrument>> instruments;
  (instruments.push_back(std::move(one)), ...);
  return linkInstruments(std::move(instruments));
}

class Triggers : public testing::Test {
 protected:
  void SetUp() override { port = {}; }
  std::vector<InstrumentNote> notes_;
};

using Controls = std::vector<std::pair<unsigned long, int>>;

TEST_F(Triggers, AParallelPortHoldsTheCodeForAPulse) {
  {
    const auto lines = openParallelPort({"parallel", "/dev/parport0", {1, 0, 4}, 0.25}, kFakeCalls);
    EXPECT_EQ(port.opened, "/dev/parport0");
    EXPECT_EQ(port.controls, (Controls{{PPCLAIM, 0}, {PPWDATA, 0}}));
    const std::int64_t before = os::now();
    EXPECT_TRUE(lines->send({Mark::Go, 1, 0}));
    const std::int64_t after = os::now();
    EXPECT_FALSE(lines->send({Mark::Onset, 1, 0})) << "0 is not sent";
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 1}));
    lines->look(before + 249'999'999, notes_);
    EXPECT_EQ(port.controls.back().second, 1) << "the pulse lasts";
    lines->look(after + 250'000'000, notes_);
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 0}));
    const std::size_t controls = port.controls.size();
    lines->look(after + 500'000'000, notes_);
    lines->end(notes_);
    EXPECT_EQ(port.controls.size(), controls) << "down once";
    EXPECT_TRUE(lines->send({Mark::Success, 1, 0}));
    lines->end(notes_);
    EXPECT_EQ(port.controls.back(), (std::pair<unsigned long, int>{PPWDATA, 0})) << "no line stays up";
  }
  EXPECT_EQ(port.controls.back().first, PPRELEASE);
  EXPECT_EQ(port.closes, 1);
}

TEST_F(Triggers, AChangeOfAnInputIsNotedOnce) {
  const auto lines = openParallelPort({"parallel", "/dev/parport0"}, kFakeCalls);
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
  const auto lines = openSerialLines({"rts", "/dev/ttyS0"}, kFakeCalls);
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
  const auto lines = openParallelPort({"parallel", "/dev/parport0"}, kFakeCalls);
  EXPECT_EQ(port.controls.front().first, PPCLAIM);
  port.error = EIO;
  EXPECT_EQ(reachlab::refusalOf([&] { lines->send({Mark::Go, 1, 0}); }), "/dev/parport0: Input/output error");
}

// What instruments say of the ticks of a made run.
std::vector<record::RecordedEvent> eventsOf(record::InstrumentLink& link, int trials) {
  link.begin(record::madeConfiguration());
  record::MadeRun run;
  for (int trial = 1; trial <= trials; ++trial) {
    link.announce(trial, {trial - 1, 5, false});
    for (std::uint64_t tick = 0; tick < record::MadeRun::kTicksPerTrial; ++tick) {
      haptics::TickState state = run.next();
      state.measuredNs = os::now();
      EXPECT_TRUE(link.onTick(state, trial::Command::None, 0));
    }
  }
  link.close();
  return link.takeEvents();
}

// The trial of a made run: armed at 20 ms, go 5 ms later, onset at 50 ms, end at 250 ms; even trials fail.
TEST_F(Triggers, WhatHappenedIsFoundAtTheTicksThatTheRecordingHasItAt) {
  const auto link = linked(openParallelPort({"parallel", "/dev/parport0"}, kFakeCalls));
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
                                                                       {325, "parallel out onset"},
                                                                       {525, "parallel out end"}}));
  EXPECT_EQ(events.back().trial, 2);
  EXPECT_TRUE(link->takeWarnings().empty());
}

class LabStreamingLayer : public testing::Test {
 protected:
  void SetUp() override { test::resetFakeLsl(); }
};

TEST_F(LabStreamingLayer, MarkersAndTheHandGoOutUnderTheTicksOwnTimes) {
  const auto link = linked(openLabStreaming("lsl"));
  const auto events = eventsOf(*link, 2);
  const test::FakeLsl& lsl = test::fakeLsl();
  ASSERT_EQ(lsl.streams.size(), 2u);
  const auto& markers = lsl.streams[0];
  EXPECT_EQ(markers.name, "reachlab-markers");
  EXPECT_EQ(markers.type, "Markers");
  EXPECT_EQ(markers.format, 3) << "text";
  EXPECT_EQ(markers.rate, 0) << "irregular";
  EXPECT_TRUE(holds(markers.clock, "monotonic"));
  const auto& hand = lsl.streams[1];
  EXPECT_EQ(hand.type, "MoCap");
  EXPECT_EQ(hand.rate, 1000);
  EXPECT_EQ(hand.labels, (std::vector<std::string>{"hand_x", "hand_y", "hand_z", "hand_vx", "hand_vy", "hand_vz"}));
  ASSERT_EQ(hand.numbers.size(), 2 * record::MadeRun::kTicksPerTrial);
  std::vector<std::string> texts;
  for (const auto& [time, text] : markers.texts) texts.push_back(text);
  EXPECT_EQ(texts, (std::vector<std::string>{"go 1", "onset 1", "success 1", "go 2", "onset 2", "end 2"}));
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
    const auto link = linked(openLabStreaming("lsl"));
    (void)eventsOf(*link, 1);
    (void)eventsOf(*link, 1);
    EXPECT_EQ(test::fakeLsl().streams.size(), 4u) << "streams of their own for each run";
    EXPECT_EQ(test::fakeLsl().alive, 4);
  }
  EXPECT_EQ(test::fakeLsl().alive, 0);
}

TEST_F(LabStreamingLayer, ThatTakesNothingAnyMoreIsLeftOut) {
  test::fakeLsl().takesNothing = true;
  const auto link = linked(openLabStreaming("lsl"));
  (void)eventsOf(*link, 1);
  const auto warnings = link->takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "instrument lsl is lost: liblsl: takes no sample any more; what follows is recorded without it");
}

TEST_F(Triggers, EachCodeIsOneByteAndNoughtIsNone) {
  {
    const auto box = openByteLine({"box", "/dev/ttyBox", {7, 0, 255}}, kFakeCalls);
    EXPECT_EQ(box->name(), "box");
    EXPECT_EQ(port.opened, "/dev/ttyBox");
    EXPECT_EQ(port.flags, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    port.interrupts = 2;
    EXPECT_TRUE(box->send({Mark::Go, 1, 0}));
    EXPECT_FALSE(box->send({Mark::Onset, 1, 0}));
    EXPECT_TRUE(box->send({Mark::Success, 1, 0}));
    EXPECT_EQ(port.written, (std::vector<unsigned char>{7, 255}));
    port.error = EIO;
    EXPECT_EQ(refusalOf([&] { box->send({Mark::Go, 1, 0}); }), "/dev/ttyBox: Input/output error");
  }
  EXPECT_EQ(port.closes, 1);
}

TEST_F(Triggers, EveryByteThatComesInIsNotedWithItsTime) {
  const auto box = openByteLine({"box", "/dev/ttyBox"}, kFakeCalls);
  box->look(5, notes_);
  EXPECT_TRUE(notes_.empty());
  port.waiting = {3, 200};
  box->look(7, notes_);
  ASSERT_EQ(notes_.size(), 2u);
  EXPECT_EQ(notes_[0].ns, 7);
  EXPECT_EQ(notes_[0].text, "in");
  EXPECT_EQ(notes_[0].value, 3);
  EXPECT_EQ(notes_[1].value, 200);
  for (const int none : {EAGAIN, EINTR}) {
    port.error = none;
    EXPECT_EQ(refusalOf([&] { box->look(8, notes_); }), "") << "none is no fault";
  }
  port.error = EIO;
  EXPECT_EQ(refusalOf([&] { box->look(8, notes_); }), "/dev/ttyBox: Input/output error");
  port.error = 0;
  port.waiting.assign(100, 1);
  notes_.clear();
  box->look(9, notes_);
  EXPECT_EQ(notes_.size(), 64u) << "the rest at the next look";
}

TEST_F(Triggers, OneThatMayNotBeOpenedSaysWhatToDo) {
  const auto refusal = [](int error, int baud = 115200) {
    port.openError = error;
    return refusalOf([&] { openByteLine({.name = "box", .path = "/dev/ttyBox", .baud = baud}, kFakeCalls); });
  };
  EXPECT_EQ(refusal(EACCES), "/dev/ttyBox: Permission denied; become a member of the group that owns it (ls -l shows it)");
  EXPECT_EQ(refusal(ENOENT), "/dev/ttyBox: No such file or directory");
  EXPECT_EQ(port.closes, 0);
  EXPECT_EQ(refusal(0, 300), "instrument: baud=300; allowed: 9600, 19200, 38400, 57600, 115200, 230400, 1000000");
}

// The speed that the line then has, and bytes both ways, by a pseudo-terminal.
TEST_F(Triggers, TheLineIsRawAndOfTheSpeedThatWasAskedFor) {
  const test::PseudoTerminal terminal;
  const std::pair<int, speed_t> speeds[] = {{9600, B9600},     {19200, B19200},   {38400, B38400},    {57600, B57600},
                                            {115200, B115200}, {230400, B230400}, {1000000, B1000000}};
  for (const auto& [baud, speed] : speeds) {
    const auto box = openByteLine({.name = "box", .path = terminal.path, .baud = baud});
    termios line{};
    ASSERT_EQ(::tcgetattr(terminal.slave, &line), 0);
    EXPECT_EQ(::cfgetospeed(&line), speed) << baud;
    EXPECT_EQ(line.c_lflag & (ICANON | ECHO), 0u) << "raw";
    EXPECT_NE(line.c_cflag & CREAD, 0u);
    EXPECT_NE(line.c_cflag & CLOCAL, 0u);
    unsigned char byte = 0;
    EXPECT_TRUE(box->send({Mark::Success, 1, 0}));
    ASSERT_EQ(::read(terminal.wire, &byte, 1), 1);
    EXPECT_EQ(byte, 4);
    ASSERT_EQ(::write(terminal.wire, "\xfe", 1), 1);
    notes_.clear();
    EXPECT_TRUE(test::until([&] { return box->look(5, notes_), !notes_.empty(); }));
    EXPECT_EQ(notes_.at(0).value, 0xfe);
  }
}

TEST(OpenInstruments, RefusesWhatItDoesNotKnowAndBoundsItsNumbers) {
  EXPECT_EQ(openInstruments({}), nullptr);
  const auto refusal = [](const std::string& spec) { return refusalOf([&] { (void)openInstruments({spec}); }); };
  EXPECT_EQ(refusal("trumpet"), "instrument: is trumpet, which is unknown; allowed: lsl, parallel:PATH, rts:PATH, byte:PATH");
  EXPECT_EQ(refusal("rts"), "instrument: rts: its port is missing; allowed: rts:/dev/…");
  EXPECT_EQ(refusal("byte,go=1"), "instrument: byte: its port is missing; allowed: byte:/dev/…");
  EXPECT_TRUE(holds(refusal("byte:/dev/null,go=256"), "go=256; allowed: a whole number from 0 to 255"));
  EXPECT_TRUE(holds(refusal("byte:/dev/null,pulse-ms=5"), "pulse-ms is not known")) << "a byte has no length";
  EXPECT_TRUE(holds(refusal("byte:/dev/null"), "/dev/null: Inappropriate ioctl for device"));
  const std::string missing = "/dev/no-such-line: No such file or directory";
  for (const char* good : {"byte:/dev/no-such-line,baud=9600,go=0,onset=255", "rts:/dev/no-such-line,pulse-ms=1",
                           "rts:/dev/no-such-line,pulse-ms=1000", "parallel:/dev/no-such-line,success=0"})
    EXPECT_EQ(refusal(good), missing) << good;
  for (const char* bad : {"byte:/dev/no-such-line,baud=0", "byte:/dev/no-such-line,baud=10000001", "rts:/dev/no-such-line,pulse-ms=0.9",
                          "rts:/dev/no-such-line,pulse-ms=1001", "parallel:/dev/no-such-line,go=-1", "parallel:/dev/no-such-line,baud=9600",
                          "lsl:x,go=1", "lsl,go=1"})
    EXPECT_NE(refusal(bad), missing) << bad;
  EXPECT_TRUE(holds(refusal("rts:/dev/no-such-line,pulse-ms=2000"), "pulse-ms=2000; allowed: a number from 1 to 1000"));
  EXPECT_EQ(openInstruments({"lsl", "lsl"})->names(), "lsl; lsl");
}

/// Keeps every call that it is made, and fails where it is told to.
struct Diarist final : Instrument {
  struct Book {
    std::vector<std::string> lines;
    std::string failsAt;
    int looks = 0, hands = 0;
  };
  Diarist(const std::string& name, std::shared_ptr<Book> b) : Instrument(name), book(std::move(b)) {}
  void add(const std::string& line) {
    book->lines.push_back(line);
    if (line == book->failsAt) throw ResourceError("no more");
  }
  void begin(const record::RunConfiguration&, std::vector<InstrumentNote>& notes) override {
    add("begin");
    notes.push_back({5, "hello", 42});
  }
  bool send(const Marker& marker) override {
    add(std::string(nameOf(marker.mark)) + " " + std::to_string(marker.trial));
    return marker.mark != Mark::Onset;
  }
  void hand(const HandAtTick&) override { ++book->hands; }
  void look(std::int64_t, std::vector<InstrumentNote>&) override { ++book->looks; }
  void end(std::vector<InstrumentNote>&) override { add("end"); }
  std::shared_ptr<Book> book;
};

TEST_F(Triggers, EveryInstrumentIsToldEverythingAndOneThatFailsNothingMore) {
  const auto one = std::make_shared<Diarist::Book>(), two = std::make_shared<Diarist::Book>();
  two->failsAt = "onset 1";
  const auto link = linked(std::make_unique<Diarist>("one", one), std::make_unique<Diarist>("two", two));
  EXPECT_EQ(link->names(), "one; two");
  EXPECT_EQ(link->massesEvery(), 0u);
  const auto events = eventsOf(*link, 2);
  EXPECT_EQ(one->lines, (std::vector<std::string>{"begin", "go 1", "onset 1", "success 1", "go 2", "onset 2", "end 2", "end"}));
  EXPECT_EQ(two->lines, (std::vector<std::string>{"begin", "go 1", "onset 1"}));
  EXPECT_EQ(one->hands, 2 * static_cast<int>(record::MadeRun::kTicksPerTrial));
  EXPECT_GE(one->looks, 1);
  std::vector<std::string> texts;
  for (const record::RecordedEvent& event : events) texts.push_back(event.text);
  EXPECT_EQ(texts, (std::vector<std::string>{"one hello at +0.000000 s", "two hello at +0.000000 s", "one out go", "two out go",
                                             "two lost: no more", "one out success", "one out go", "one out end"}));
  EXPECT_EQ(events[0].value, 42);
  EXPECT_EQ(events[0].tick, 0u) << "before the first tick";
  EXPECT_EQ(events[4].tick, 50u);
  EXPECT_EQ(events[4].trial, 1);
  EXPECT_EQ(events[4].value, 0);
  EXPECT_EQ(link->takeWarnings(), std::vector<std::string>{"instrument two is lost: no more; what follows is recorded without it"});
  EXPECT_TRUE(link->takeWarnings().empty()) << "taken once";
  EXPECT_TRUE(link->takeEvents().empty());
}

}  // namespace
}  // namespace reachlab::devices
