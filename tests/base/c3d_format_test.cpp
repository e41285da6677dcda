#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "base/c3d_file.h"
#include "tests/refusal.h"

/// The bytes of a C3D file, laid out here by hand after the format's guide (c3d.org): the writer is held against them, and the reader reads
/// those that the writer never makes.
namespace reachlab {
namespace {

std::string word(unsigned value) { return {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)}; }
std::string words(std::initializer_list<unsigned> values) {
  std::string bytes;
  for (const unsigned value : values) bytes += word(value);
  return bytes;
}
std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    bytes += word(bits & 0xffff) + word(bits >> 16);
  }
  return bytes;
}
std::string padded(std::string bytes) {
  bytes.resize((bytes.size() + 511) / 512 * 512, '\0');
  return bytes;
}
std::string counted(const std::string& text) { return static_cast<char>(text.size()) + text; }

// Length and number, name, the way to the next record, the description.
std::string group(int number, const std::string& name, const std::string& description = "") {
  return static_cast<char>(name.size()) + (static_cast<char>(-number) + name) + word(3 + static_cast<unsigned>(description.size())) +
         counted(description);
}
std::string parameter(int number, const std::string& name, int type, const std::vector<int>& dimensions, const std::string& data,
                      const std::string& description = "") {
  std::string body{static_cast<char>(type), static_cast<char>(dimensions.size())};
  for (const int size : dimensions) body += static_cast<char>(size);
  body += data + counted(description);
  return static_cast<char>(name.size()) + (static_cast<char>(number) + name) + word(2 + static_cast<unsigned>(body.size())) + body;
}
std::string section(const std::string& records) {
  std::string bytes = padded(std::string{1, 0x50, 0, 84} + records + std::string(2, '\0'));
  bytes[2] = static_cast<char>(bytes.size() / 512);
  return bytes;
}

constexpr int kText = -1, kByte = 1, kWord = 2, kFloat = 4;

TEST(C3dFormat, AFileIsTheBytesThatTheGuideHas) {
  C3dFile file;
  file.rate = 250;
  file.pointUnit = "mm";
  file.points = {{"hand", "what was moved"}, {"goal"}};
  file.analogs = {{"fx", "force", "N"}};
  file.frames = 3;
  for (int i = 0; i < 18; ++i) file.places.push_back(1.5f * static_cast<float>(i + 1));
  file.seen = {1, 1, 0, 1, 1, 1};
  file.signals = {7, 8.5f, -9};
  file.events = {{"start", 0.5}, {"end", 125.25}};
  file.notes = {{"OUTCOME", "success"}, {"EMPTY", ""}};

  const std::string records =
      group(1, "POINT", "3D points") + parameter(1, "USED", kWord, {}, word(2)) +
      parameter(1, "SCALE", kFloat, {}, floats({-1}), "negative: floating point") +
      parameter(1, "RATE", kFloat, {}, floats({250}), "frames a second") + parameter(1, "DATA_START", kWord, {}, word(4)) +
      parameter(1, "FRAMES", kWord, {}, word(3)) + parameter(1, "LABELS", kText, {4, 2}, "handgoal") +
      parameter(1, "DESCRIPTIONS", kText, {14, 2}, "what was moved" + std::string(14, ' ')) + parameter(1, "UNITS", kText, {2, 1}, "mm") +
      parameter(1, "X_SCREEN", kText, {2}, "+X") + parameter(1, "Y_SCREEN", kText, {2}, "+Y") + group(2, "ANALOG", "signals") +
      parameter(2, "USED", kWord, {}, word(1)) + parameter(2, "LABELS", kText, {2, 1}, "fx") +
      parameter(2, "DESCRIPTIONS", kText, {5, 1}, "force") + parameter(2, "UNITS", kText, {1, 1}, "N") +
      parameter(2, "GEN_SCALE", kFloat, {}, floats({1})) + parameter(2, "SCALE", kFloat, {1}, floats({1})) +
      parameter(2, "OFFSET", kWord, {1}, word(0)) + parameter(2, "RATE", kFloat, {}, floats({250}), "samples a second") +
      group(3, "FORCE_PLATFORM", "none") + parameter(3, "USED", kWord, {}, word(0)) + group(4, "TRIAL", "what the header cannot count") +
      parameter(4, "ACTUAL_START_FIELD", kWord, {2}, words({1, 0}), "first frame: low, high word") +
      parameter(4, "ACTUAL_END_FIELD", kWord, {2}, words({3, 0}), "last frame: low, high word") + group(5, "EVENT") +
      parameter(5, "USED", kWord, {}, word(2)) + parameter(5, "CONTEXTS", kText, {7, 2}, "GeneralGeneral") +
      parameter(5, "LABELS", kText, {5, 2}, "startend  ") +
      parameter(5, "TIMES", kFloat, {2, 2}, floats({0, 0.5f, 2, 5.25f}), "minutes, seconds") + group(6, "REACHLAB", "what was recorded") +
      parameter(6, "OUTCOME", kText, {7}, "success") + parameter(6, "EMPTY", kText, {1}, " ");
  ASSERT_EQ(section(records).size(), 2u * 512) << "the data are the fourth block";

  std::string header = std::string{2, 0x50} + words({2, 1, 1, 3, 0}) + floats({-1}) + words({4, 1}) + floats({250});
  header.resize(298, '\0');
  header += words({12345, 2, 0}) + floats({0.5f, 125.25f}) + std::string(std::size_t{16 * 4}, '\0');
  header += std::string{1, 1} + std::string(16, '\0') + word(0) + "starend " + std::string(std::size_t{16 * 4}, ' ');

  std::string data;
  for (int frame = 0; frame < 3; ++frame) {
    for (int i = 2 * frame; i < 2 * frame + 2; ++i) {
      const auto first = static_cast<float>(3 * i);
      data += i == 2 ? floats({0, 0, 0, -1}) : floats({1.5f * (first + 1), 1.5f * (first + 2), 1.5f * (first + 3), 0});
    }
    data += floats({file.signals[static_cast<std::size_t>(frame)]});
  }
  EXPECT_EQ(c3dBytes(file), padded(header) + section(records) + padded(data));
  const C3dFile back = readC3d(c3dBytes(file), "made.c3d");
  EXPECT_EQ(back.rate, 250);
  EXPECT_EQ(back.pointUnit, "mm");
  EXPECT_EQ(back.frames, 3u);
  EXPECT_EQ(back.seen, file.seen);
  EXPECT_EQ(back.points.at(1).name, "goal");
  for (std::size_t i = 0; i < file.places.size(); ++i) EXPECT_EQ(back.places[i], i / 3 == 2 ? 0 : file.places[i]) << i;
  ASSERT_EQ(back.events.size(), 2u);
  EXPECT_EQ(back.events[0].label, "start");
  EXPECT_EQ(back.events[0].time, 0.5);
  EXPECT_EQ(back.events[1].time, 125.25);
}

TEST(C3dFormat, WhatAFieldCannotHoldIsCutOrStandsInTheNextOne) {
  C3dFile file;
  file.points.assign(256, {"p"});
  file.points[255].name = "the last";
  file.points[0].description = std::string(130, 'd');
  file.notes = {{"LONG", std::string(254, 'n') + "ox"}};
  for (int i = 0; i < 20; ++i) file.events.push_back({"event" + std::to_string(i), i + 0.5});
  file.frames = 1;
  file.places.assign(3 * 256, 0);
  file.seen.assign(256, 1);
  const std::string bytes = c3dBytes(file);
  EXPECT_TRUE(holds(bytes, parameter(6, "LONG", kText, {255}, std::string(254, 'n') + "o")));
  EXPECT_TRUE(holds(bytes, parameter(1, "LABELS2", kText, {8, 1}, "the last"))) << "as wide as the widest of all";
  EXPECT_TRUE(holds(bytes, parameter(1, "DESCRIPTIONS2", kText, {127, 1}, std::string(127, ' '))));
  EXPECT_FALSE(holds(bytes, "LABELS3"));
  EXPECT_EQ(bytes.substr(300, 2), word(18)) << "events of the header";
  EXPECT_EQ(bytes.substr(304 + 4 * 17, 4), floats({17.5f}));
  EXPECT_EQ(bytes.substr(376, 20), std::string(18, '\x01') + word(0));
  EXPECT_EQ(bytes.substr(396 + 4 * 17, 4), "even");
  EXPECT_EQ(bytes.substr(468, 44), std::string(44, '\0'));
  EXPECT_EQ(readC3d(bytes, "made").events.size(), 20u);
  EXPECT_EQ(readC3d(bytes, "made").points[255].name, "the last");
}

TEST(C3dFormat, HoldsSoManyAndNoMore) {
  const auto refusal = [](std::size_t points, std::size_t signals, std::size_t frames) -> std::string {
    C3dFile file;
    file.points.resize(points);
    file.analogs.resize(signals);
    file.frames = frames;
    return reachlab::refusalOf([&] { (void)c3dBytes(file); });
  };
  const std::string counts = "a C3D file holds 65535 points and channels, and 2147483647 frames at most";
  EXPECT_EQ(refusal(65'536, 0, 0), counts);
  EXPECT_EQ(refusal(1, 65'536, 0), counts);
  EXPECT_EQ(refusal(1, 0, 2'147'483'648), counts);
  EXPECT_EQ(refusal(65'535, 65'535, 0), "a C3D file cannot hold the names of so many points and channels");
  EXPECT_EQ(refusal(1, 0, 0), "");
}

C3dFile filled(std::size_t points, std::size_t signals, std::size_t frames) {
  C3dFile file;
  for (std::size_t i = 0; i < points; ++i) file.points.push_back({"p" + std::to_string(i), "point"});
  for (std::size_t i = 0; i < signals; ++i) file.analogs.push_back({"s" + std::to_string(i), "signal", "N"});
  file.frames = frames;
  file.places.assign(3 * points * frames, 0.25f);
  file.seen.assign(points * frames, 1);
  file.signals.assign(signals * frames, 1.5f);
  return file;
}

// The header counts frames in 16 bits.
TEST(C3dFormat, HoldsMoreFramesThanItsHeaderCounts) { EXPECT_EQ(readC3d(c3dBytes(filled(1, 0, 70000)), "made.c3d").frames, 70000u); }

// The blocks of the section are counted in a byte. A note of 255 letters is half of one, so that every count about the limit comes up.
TEST(C3dFormat, IsReadBackOrRefusedHoweverFullItsSectionIs) {
  int read = 0, refused = 0;
  for (std::size_t notes = 470; notes < 500; ++notes) {
    C3dFile file = filled(2, 0, 1);
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
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

// What other programs need to turn what is stored into volts: a common scale, and a scale and an offset a channel.
TEST(C3dFormat, SaysHowItsSignalsAreScaled) {
  const std::string bytes = c3dBytes(filled(1, 300, 2));
  for (const char* name : {"GEN_SCALE", "SCALE", "SCALE2", "OFFSET", "OFFSET2"}) {
    const std::string record = std::string(1, static_cast<char>(std::strlen(name))) + '\x02' + name;  // of the second group
    EXPECT_TRUE(holds(bytes, record)) << name;
  }
}

// ---- what the writer never makes

struct Made {
  unsigned points = 1, signals = 0, first = 1, last = 2;
  float scale = -1, rate = 50;
  std::string records = {};
  std::string data = floats({1, 2, 3, 0, 4, 5, 6, 0});
  unsigned sectionBlock = 2;

  std::string bytes() const {
    std::string header = std::string{static_cast<char>(sectionBlock), 0x50} + words({points, signals, first, last, 0}) + floats({scale});
    const std::string parameters = section(records);
    header += word(sectionBlock + static_cast<unsigned>(parameters.size()) / 512) + word(0) + floats({rate});
    header.resize((std::size_t{sectionBlock} - 1) * 512, '\0');
    return header + parameters + padded(data);
  }
  C3dFile read() const { return readC3d(bytes(), "made"); }
  std::string refusal() const {
    return reachlab::refusalOf([&] { (void)read(); });
  }
};

TEST(C3dFormat, ReadsAFileWithoutParametersByItsHeader) {
  const C3dFile file = Made{}.read();
  EXPECT_EQ(file.rate, 50);
  EXPECT_EQ(file.frames, 2u);
  EXPECT_EQ(file.pointUnit, "");
  EXPECT_EQ(file.points[0].name, "point1");
  EXPECT_EQ(file.places, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_TRUE(file.events.empty());
  EXPECT_EQ(Made{.sectionBlock = 4}.read().places, file.places) << "the parameters may stand further on";
}

TEST(C3dFormat, ReadsEventsThatHaveALabelAndATime) {
  Made made;
  const auto events = [&](const std::string& labels, const std::string& times, int type = kFloat) {
    made.records = group(1, "EVENT") + parameter(1, "LABELS", kText, {1, static_cast<int>(labels.size())}, labels) +
                   parameter(1, "TIMES", type, {2, static_cast<int>(times.size()) / 2 / std::abs(type)}, times);
    return made.read().events;
  };
  const std::vector<C3dEvent> two = events("ab", floats({1, 2.5f, 3, 4}));
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].time, 62.5);
  EXPECT_EQ(two[1].label + std::to_string(two[1].time), "b184.000000");
  EXPECT_EQ(events("abc", floats({1, 2, 3, 4})).size(), 2u);
  EXPECT_EQ(events("a", floats({1, 2, 3, 4})).size(), 1u);
  EXPECT_EQ(events("a", words({1, 2, 3, 4}), kWord).size(), 0u) << "no floats";
  EXPECT_EQ(events("ab", floats({1, std::numeric_limits<float>::quiet_NaN(), 0, 4})).at(0).label, "b");
}

TEST(C3dFormat, APlaceThatIsNoNumberWasNotSeen) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN(), kFar = std::numeric_limits<float>::infinity();
  Made made{.last = 4, .data = floats({kNone, 2, 3, 0, 1, kFar, 3, 0, 1, 2, -kFar, 0, 1, 2, 3, kNone})};
  EXPECT_EQ(made.read().seen, (std::vector<char>{0, 0, 0, 0}));
}

TEST(C3dFormat, RefusesNumbersThatAFileCannotHave) {
  const auto rate = [](float value) { return Made{.rate = value}.refusal(); };
  EXPECT_EQ(rate(0), "made: has 0 frames a second; allowed: more than 0");
  EXPECT_EQ(rate(-50), "made: has -50 frames a second; allowed: more than 0");
  EXPECT_EQ(rate(1e6f), "made: has 1000000 frames a second; allowed: more than 0");
  EXPECT_EQ(rate(999'999), "");
  EXPECT_EQ(rate(std::numeric_limits<float>::quiet_NaN()), "made: has nan frames a second; allowed: more than 0");
  EXPECT_EQ(Made{.scale = 0}.refusal(), "made: has the scale 0; allowed: a number that is not 0");
  EXPECT_EQ(Made{.points = 0}.refusal(), "made: has no points; allowed: at least one point");
  EXPECT_EQ(Made{.scale = -std::numeric_limits<float>::infinity()}.refusal(), "made: has the scale -inf; allowed: a number that is not 0");
}

TEST(C3dFormat, RefusesWhatEndsTooSoonAndReadsWhatJustDoesNot) {
  Made made{.last = 32, .data = std::string(512, '\0')};
  EXPECT_EQ(made.refusal(), "") << "32 frames are the block";
  made.last = 33;
  EXPECT_EQ(made.refusal(), "made: says 33 frames, and has 32; allowed: a whole file");
  const std::string whole = Made{}.bytes();
  const auto refusalOf = [](const std::string& bytes) -> std::string { return reachlab::refusalOf([&] { (void)readC3d(bytes, "made"); }); };
  EXPECT_EQ(refusalOf(whole.substr(0, 1023)), "made: ends before its parameters; allowed: a whole file");
  EXPECT_EQ(refusalOf(whole.substr(0, 1024)), "made: says 2 frames, and has 0; allowed: a whole file");
  EXPECT_EQ(refusalOf(""), "made: is no C3D file; allowed: a file that begins with the bytes of C3D");
  EXPECT_EQ(refusalOf(std::string(600, 'x')), "made: is no C3D file; allowed: a file that begins with the bytes of C3D");
  EXPECT_EQ(refusalOf(whole.substr(0, 511)), "made: is no C3D file; allowed: a file that begins with the bytes of C3D");
  std::string changed = whole;
  changed[0] = 0;
  EXPECT_EQ(refusalOf(changed), "made: ends before its parameters; allowed: a whole file") << "they cannot be the header";
  changed = whole;
  changed[512 + 3] = 7;
  EXPECT_EQ(refusalOf(changed), "made: is of processor type 7; allowed: 84 (Intel), 85 (DEC), 86 (MIPS)");
  changed = whole;
  changed[16] = 1;
  EXPECT_EQ(refusalOf(changed).substr(0, 26), "made: says 2 frames, and h") << "the data cannot be the header";
  changed[16] = 0;
  EXPECT_NE(refusalOf(changed), "");
  changed[16] = 5;
  EXPECT_EQ(refusalOf(changed), "made: says 2 frames, and has 0; allowed: a whole file") << "behind the end";
}

// A file that ends with the parameter section; `records` end with its last byte where they are as long as the block.
std::string refusalOfRecords(const std::string& records) {
  std::string bytes = Made{.data = ""}.bytes().substr(0, 512 + 4) + records;
  if (bytes.size() < 1024) bytes.resize(1024);
  return reachlab::refusalOf([&] { (void)readC3d(bytes, "made"); });
}
const char* const kReadOn = "made: says 2 frames, and has 0; allowed: a whole file";  // the parameters are fine, there are no data

TEST(C3dFormat, RefusesParametersThatLeadNowhere) {
  std::string record = parameter(1, "RATE", kByte, {}, "1");
  record[2 + 4] = 1;
  EXPECT_EQ(refusalOfRecords(record), "made: has a parameter RATE that leads nowhere; allowed: parameters one after the other");
  record[2 + 4] = 0;
  EXPECT_EQ(refusalOfRecords(record), kReadOn) << "0 ends the list";
  EXPECT_EQ(refusalOfRecords(parameter(1, "MANY", kByte, std::vector<int>(8, 1), "1")),
            "made: has a parameter MANY of too many dimensions; allowed: up to 7");
  EXPECT_EQ(refusalOfRecords(parameter(1, "MANY", kByte, std::vector<int>(7, 1), "1")), kReadOn);
  EXPECT_EQ(refusalOfRecords(parameter(1, "GREAT", kByte, {100, 100}, "1")),
            "made: has a parameter GREAT greater than the file; allowed: a whole file");
  EXPECT_EQ(refusalOfRecords(parameter(1, "GREAT", kByte, {128, 8}, "1")), "made: ends within its parameter GREAT; allowed: a whole file");
}

TEST(C3dFormat, WhatIsNoTextIsNoName) {
  Made made;
  made.records = group(1, "POINT") + parameter(1, "LABELS", kByte, {1, 1}, "a");
  EXPECT_EQ(made.read().points[0].name, "point1");
  made.records = group(1, "POINT") + parameter(1, "LABELS", kText, {}, "a");
  EXPECT_EQ(made.read().points[0].name, "point1") << "no dimension";
  made.records = group(1, "POINT") + parameter(1, "LABELS", kText, {0, 3}, "");
  EXPECT_EQ(made.read().points[0].name, "point1") << "no width";
}

TEST(C3dFormat, ANumberThatIsTooShortIsNone) {
  for (const auto& [type, size] : {std::pair{kFloat, 4}, {kWord, 2}, {kByte, 1}}) {
    Made made;
    made.records = group(1, "POINT") + parameter(1, "RATE", type, {0}, "");
    EXPECT_EQ(made.read().rate, 50) << "the header's, not one of " << size << " bytes that are not there";
  }
  Made made;
  made.records = group(1, "POINT") + parameter(1, "RATE", kText, {4}, "1234");
  EXPECT_EQ(made.read().rate, 50);
}

// Other systems choose differently.
TEST(C3dFormat, ReadsNumbersOfEveryWidth) {
  Made made;
  const auto rate = [&](int type, const std::string& data) {
    made.records = group(1, "POINT") + parameter(1, "RATE", type, {}, data);
    return made.read().rate;
  };
  EXPECT_EQ(rate(kByte, "d"), 100);
  EXPECT_EQ(rate(kWord, word(0x1234)), 0x1234);
  EXPECT_EQ(rate(kFloat, floats({125})), 125) << "not the header's";
}

TEST(C3dFormat, ReadsScaledIntegers) {
  const C3dFile file = Made{.last = 3,
                            .records = group(1, "POINT") + parameter(1, "SCALE", kFloat, {}, floats({0.1f})),
                            .data = words({10, 0x10000 - 20, 30000, 0, 1, 2, 3, 0xffff, 4, 5, 6, 258})}
                           .read();
  EXPECT_FLOAT_EQ(file.places[0], 1.0f);
  EXPECT_FLOAT_EQ(file.places[1], -2.0f);
  EXPECT_FLOAT_EQ(file.places[2], 3000.0f);
  EXPECT_EQ(file.seen, (std::vector<char>{1, 0, 1}));
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

TEST(C3dFormat, ReadsTheNumbersOfOtherProcessors) {
  for (const unsigned char processor : {'\x55', '\x56'}) {
    const C3dFile back = readC3d(foreignBytes(processor), "made.c3d");
    EXPECT_EQ(back.rate, 120) << int{processor};
    EXPECT_EQ(back.places, (std::vector<float>{-2, -0.5, 1, 4, 5.5, 7})) << int{processor};
    EXPECT_EQ(back.seen, (std::vector<char>{0, 1})) << int{processor};
  }
}

// Every file is either read or refused: run under sanitizers by `packaging/test --all`.
TEST(C3dFormat, SurvivesDamage) {
  const std::string good = c3dBytes(filled(2, 2, 20));
  std::uint64_t state = 7;
  const auto next = [&state] { return state = state * 6364136223846793005ull + 1442695040888963407ull; };
  for (int round = 0; round < 2000; ++round) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) bytes[(next() >> 33) % std::min<std::size_t>(bytes.size(), 3000)] = static_cast<char>(next() >> 40);
    if (round % 4 == 0) bytes.resize((next() >> 33) % bytes.size());
    (void)reachlab::refusalOf([&] { (void)readC3d(bytes, "made.c3d"); });
  }
}

// The section's block holds 508 bytes of records: the last one ends with it, or a byte later.
TEST(C3dFormat, ReadsToTheLastByteAndNotBeyond) {
  const auto endingAt = [](std::size_t end, const std::string& last) {
    return group(1, "A", std::string(end - group(1, "A").size() - last.size(), 'x')) + last;
  };
  const std::string whole = parameter(1, "B", kByte, {2}, "12").substr(0, 3 + 2 + 3 + 2);  // without its description's length
  EXPECT_EQ(refusalOfRecords(endingAt(508, "")), kReadOn);
  for (const std::size_t missing : {0, 1, 2}) {
    const std::string told = refusalOfRecords(endingAt(508, whole.substr(0, whole.size() - missing)));
    EXPECT_EQ(told, missing == 0 ? kReadOn : "made: ends within its parameter B; allowed: a whole file") << missing;
  }
  EXPECT_EQ(refusalOfRecords(endingAt(508, whole.substr(0, 3 + 2 + 2))), "made: has a parameter B of too many dimensions; allowed: up to 7")
      << "its dimension is missing";
  EXPECT_EQ(refusalOfRecords(endingAt(508, whole.substr(0, 3 + 2 + 1))), "made: ends within its parameter B; allowed: a whole file");
  EXPECT_EQ(refusalOfRecords(endingAt(508, whole.substr(0, 3 + 1))), "made: ends within its parameters; allowed: a whole file");
}

}  // namespace
}  // namespace reachlab
