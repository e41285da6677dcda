#include "base/c3d_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "base/error.h"
#include "tests/refusal.h"

namespace reachlab {
namespace {

C3dFile made(std::size_t points, std::size_t signals, std::size_t frames) {
  C3dFile file;
  file.rate = 250;
  file.pointUnit = "mm";
  for (std::size_t i = 0; i < points; ++i) file.points.push_back({"p" + std::to_string(i), "point"});
  for (std::size_t i = 0; i < signals; ++i) file.analogs.push_back({"s" + std::to_string(i), "signal", "N"});
  file.frames = frames;
  for (std::size_t i = 0; i < 3 * points * frames; ++i) file.places.push_back(0.25f * static_cast<float>(i));
  file.seen.assign(points * frames, 1);
  file.signals.assign(signals * frames, 1.5f);
  file.events = {{"go", 0.1}, {"end", 61.5}};
  file.notes = {{"OUTCOME", "success"}, {"EMPTY", ""}};
  return file;
}

TEST(C3dFile, ReadsBackItsPoints) {
  C3dFile file = made(3, 2, 10);
  file.seen[4] = 0;
  const C3dFile back = readC3d(c3dBytes(file), "made.c3d");
  EXPECT_EQ(back.rate, 250);
  EXPECT_EQ(back.pointUnit, "mm");
  EXPECT_EQ(back.frames, 10u);
  EXPECT_EQ(back.seen, file.seen);
  ASSERT_EQ(back.points.size(), 3u);
  EXPECT_EQ(back.points[2].name, "p2");
  for (std::size_t i = 0; i < file.places.size(); ++i) {
    EXPECT_EQ(back.places[i], i / 3 == 4 ? 0 : file.places[i]) << i;
  }
  ASSERT_EQ(back.events.size(), 2u);
  EXPECT_EQ(back.events[0].label, "go");
  EXPECT_NEAR(back.events[0].time, 0.1, 1e-8) << "single precision";
  EXPECT_EQ(back.events[1].label, "end");
  EXPECT_EQ(back.events[1].time, 61.5);
}

// A parameter's dimensions are bytes: 255 labels at most.
TEST(C3dFile, HoldsMorePointsThanOneParameterNames) {
  const C3dFile back = readC3d(c3dBytes(made(514, 0, 2)), "made.c3d");
  EXPECT_EQ(back.points[0].name, "p0");
  EXPECT_EQ(back.points[254].name, "p254");
  EXPECT_EQ(back.points[255].name, "p255");
  EXPECT_EQ(back.points[513].name, "p513");
}

// The header counts frames in 16 bits.
TEST(C3dFile, HoldsMoreFramesThanItsHeaderCounts) { EXPECT_EQ(readC3d(c3dBytes(made(1, 0, 70000)), "made.c3d").frames, 70000u); }

// What other systems write.
TEST(C3dFile, ReadsScaledIntegers) {
  C3dFile file = made(1, 0, 3);
  std::string bytes = c3dBytes(file);
  const std::size_t data = 512 * (static_cast<std::size_t>(static_cast<unsigned char>(bytes[16])) - 1);
  const float scale = 0.1f;
  const auto bits = std::bit_cast<std::uint32_t>(scale);
  const std::size_t parameter = bytes.find("SCALE") + 5 + 2 + 2;  // next, type, rank
  for (std::size_t k = 0; k < 4; ++k) bytes[12 + k] = bytes[parameter + k] = static_cast<char>(bits >> (8 * k));
  bytes.resize(data);
  for (const int value : {10, -20, 30000, 0, 1, 2, 3, -1, 4, 5, 6, 258}) {
    bytes += static_cast<char>(value & 0xff);
    bytes += static_cast<char>((value >> 8) & 0xff);
  }
  const C3dFile back = readC3d(bytes, "made.c3d");
  EXPECT_FLOAT_EQ(back.places[0], 1.0f);
  EXPECT_FLOAT_EQ(back.places[1], -2.0f);
  EXPECT_FLOAT_EQ(back.places[2], 3000.0f);
  EXPECT_EQ(back.seen, (std::vector<char>{1, 0, 1}));
}

// A number may be a byte, a word or a float; other systems choose differently.
TEST(C3dFile, ReadsNumbersOfEveryWidth) {
  const std::string good = c3dBytes(made(2, 1, 4));
  const std::size_t rate = good.find("RATE") + 4 + 2;  // type, rank, four bytes, no description
  ASSERT_EQ(good[rate], 4);
  for (const auto& [type, size] : {std::pair{2, 2}, {1, 1}}) {
    std::string bytes = good;
    bytes[rate] = static_cast<char>(type);
    bytes[rate + 2] = 100, bytes[rate + 3] = 0;
    EXPECT_EQ(readC3d(bytes, "made.c3d").rate, 100) << size << " bytes";
  }
  std::string bytes = good;
  const auto bits = std::bit_cast<std::uint32_t>(125.0f);
  for (std::size_t k = 0; k < 4; ++k) bytes[rate + 2 + k] = static_cast<char>(bits >> (8 * k));
  EXPECT_EQ(readC3d(bytes, "made.c3d").rate, 125) << "not the header's";
}

// The blocks of the section are counted in a byte. A note of 255 letters is half of one, so that every count about the limit comes up.
TEST(C3dFile, IsReadBackOrRefusedHoweverFullItsSectionIs) {
  int read = 0, refused = 0;
  for (std::size_t notes = 470; notes < 500; ++notes) {
    C3dFile file = made(2, 0, 1);
    file.notes.assign(notes, {"NOTE", std::string(255, 'x')});
    std::string bytes;
    try {
      bytes = c3dBytes(file);
    } catch (const Error&) {
      ++refused;
      continue;
    }
    ++read;
    const auto byteAt = [&](std::size_t place) { return static_cast<unsigned char>(bytes[place]); };
    EXPECT_EQ(2 + byteAt(512 + 2), byteAt(16) + 256 * byteAt(17)) << notes << ": behind the header and its blocks come the data";
    const C3dFile back = readC3d(bytes, "made.c3d");
    ASSERT_EQ(back.points.size(), 2u) << notes;
    EXPECT_EQ(back.points[1].name, "p1") << notes;
    EXPECT_EQ(back.pointUnit, "mm") << notes;
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

// What other programs need to turn what is stored into volts: a common scale, and a scale and an offset a channel.
TEST(C3dFile, SaysHowItsSignalsAreScaled) {
  const std::string bytes = c3dBytes(made(1, 300, 2));
  for (const char* name : {"GEN_SCALE", "SCALE", "SCALE2", "OFFSET", "OFFSET2"}) {
    const std::string record = std::string(1, static_cast<char>(std::strlen(name))) + '\x02' + name;  // of the second group
    EXPECT_NE(bytes.find(record), std::string::npos) << name;
  }
}

// Two frames of one point by a processor that has its bytes in another order; no parameters, so that the header alone says how they are.
std::string foreignBytes(unsigned char processor) {
  std::string bytes(2 * 512, '\0');
  const auto put = [&](std::size_t at, unsigned value) {
    const bool bigEndian = processor == 86;
    bytes[at + (bigEndian ? 1 : 0)] = static_cast<char>(value & 0xff);
    bytes[at + (bigEndian ? 0 : 1)] = static_cast<char>(value >> 8);
  };
  const auto putFloat = [&](std::size_t at, float value) {
    // DEC: the word with sign and exponent first, and four times the value by its exponent.
    const auto bits = std::bit_cast<std::uint32_t>(processor == 85 ? 4 * value : value);
    put(at, bits >> 16);
    put(at + 2, bits & 0xffff);
  };
  bytes[0] = 2, bytes[1] = 0x50;
  put(2, 1), put(6, 1), put(8, 2);
  putFloat(12, -1);
  put(16, 3);
  putFloat(20, 120);
  bytes[512 + 1] = 0x50, bytes[512 + 2] = 1, bytes[512 + 3] = static_cast<char>(processor);
  bytes.resize(3 * 512, '\0');
  for (std::size_t i = 0; i < 8; ++i) putFloat(1024 + 4 * i, i == 3 ? -1.0f : i == 7 ? 0.0f : 1.5f * static_cast<float>(i) - 2);
  return bytes;
}

TEST(C3dFile, ReadsTheNumbersOfOtherProcessors) {
  for (const unsigned char processor : {'\x55', '\x56'}) {
    const C3dFile back = readC3d(foreignBytes(processor), "made.c3d");
    EXPECT_EQ(back.rate, 120) << int{processor};
    EXPECT_EQ(back.places, (std::vector<float>{-2, -0.5, 1, 4, 5.5, 7})) << int{processor};
    EXPECT_EQ(back.seen, (std::vector<char>{0, 1})) << int{processor};
  }
}

std::string refusalOf(const std::string& bytes) {
  return reachlab::refusalOf([&] { (void)readC3d(bytes, "made.c3d"); });
}

TEST(C3dFile, RefusesInWordsWhatIsNoSuchFile) {
  const std::string good = c3dBytes(made(3, 1, 200));
  EXPECT_EQ(refusalOf(good), "");
  EXPECT_EQ(refusalOf(""), "made.c3d: is no C3D file; allowed: a file that begins with the bytes of C3D");
  EXPECT_EQ(refusalOf(std::string(600, 'x')), "made.c3d: is no C3D file; allowed: a file that begins with the bytes of C3D");
  std::string processor = good;
  processor[512 + 3] = 7;
  EXPECT_EQ(refusalOf(processor), "made.c3d: is of processor type 7; allowed: 84 (Intel), 85 (DEC), 86 (MIPS)");
  std::string none = good;
  none[2] = none[3] = 0;
  EXPECT_EQ(refusalOf(none), "made.c3d: has no points; allowed: at least one point");
}

// Every file is either read or refused: run under sanitizers by `packaging/test --all`.
TEST(C3dFile, SurvivesDamage) {
  const std::string good = c3dBytes(made(2, 2, 20));
  std::uint64_t state = 7;
  const auto next = [&state] { return state = state * 6364136223846793005ull + 1442695040888963407ull; };
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) bytes[(next() >> 33) % std::min<std::size_t>(bytes.size(), 3000)] = static_cast<char>(next() >> 40);
    if (round % 4 == 0) bytes.resize((next() >> 33) % bytes.size());
    (void)refusalOf(bytes);
  }
}

}  // namespace
}  // namespace reachlab
