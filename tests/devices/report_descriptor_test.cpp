#include "devices/hid/report_descriptor.h"

#include <gtest/gtest.h>

#include <random>

#include "base/fault.h"

namespace reachlab::devices {
namespace {

using Bytes = std::vector<std::uint8_t>;

// Items of HID 1.11, sec. 6.2.2: four bits of tag, two of kind, two of size.
enum Tag : int {
  kInput = 0x80,
  kOutput = 0x90,
  kCollection = 0xA0,
  kFeature = 0xB0,
  kEnd = 0xC0,
  kPage = 0x04,
  kLeast = 0x14,
  kMost = 0x24,
  kSize = 0x74,
  kReport = 0x84,
  kCount = 0x94,
  kPush = 0xA4,
  kPop = 0xB4,
  kUsage = 0x08,
  kFirst = 0x18,
  kLast = 0x28,
};
Bytes item(int tag, std::uint32_t value, int bytes = 1) {
  Bytes out{static_cast<std::uint8_t>(tag | (bytes == 4 ? 3 : bytes))};
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
  return out;
}
Bytes joined(const std::vector<Bytes>& items) {
  Bytes all;
  for (const Bytes& one : items) all.insert(all.end(), one.begin(), one.end());
  return all;
}
HidLayout parse(const std::vector<Bytes>& items) { return parseReportDescriptor(joined(items)); }
std::string refusalOf(const std::vector<Bytes>& items) {
  try {
    (void)parse(items);
  } catch (const FaultError& error) {
    return error.faults.at(0).key + ": " + error.faults.at(0).what;
  }
  return "read";
}

constexpr int kVariable = 2, kArray = 0, kConstantBits = 3;

// One variable X, with limits in as many bytes.
HidField fieldOf(const Bytes& least, const Bytes& most) {
  return parse({item(kPage, 1), item(kUsage, 0x30), least, most, item(kSize, 16), item(kCount, 1), item(kInput, kVariable)}).fields.at(0);
}

TEST(ReportDescriptor, LimitsAreSignedNumbersOfNoneOneTwoOrFourBytes) {
  const HidField short1 = fieldOf(item(kLeast, 0x81), item(kMost, 0x7F));
  EXPECT_EQ(short1.least, -127);
  EXPECT_EQ(short1.most, 127);
  const HidField short2 = fieldOf(item(kLeast, 0x8001, 2), item(kMost, 0x7FFE, 2));
  EXPECT_EQ(short2.least, -32767);
  EXPECT_EQ(short2.most, 32766);
  const HidField long4 = fieldOf(item(kLeast, 0xFFFFFFFE, 4), item(kMost, 0x01020304, 4));
  EXPECT_EQ(long4.least, -2);
  EXPECT_EQ(long4.most, 0x01020304);
  const HidField none = fieldOf(item(kLeast, 0, 0), item(kMost, 5));
  EXPECT_EQ(none.least, 0);
  EXPECT_EQ(none.most, 5);
}

TEST(ReportDescriptor, AByteOf255IsMeantSoWhereNothingIsNegative) {
  EXPECT_EQ(fieldOf(item(kLeast, 0), item(kMost, 0xFF)).most, 255);
  EXPECT_EQ(fieldOf(item(kLeast, 1), item(kMost, 0xFF)).most, 255);
  EXPECT_EQ(fieldOf(item(kLeast, 0xFF), item(kMost, 0xFF)).most, -1) << "beside a negative one it is -1";
  EXPECT_EQ(fieldOf(item(kLeast, 0), item(kMost, 0xFFFF, 2)).most, 65535);
  EXPECT_EQ(fieldOf(item(kLeast, 0), item(kMost, 0)).most, 0);
}

TEST(ReportDescriptor, FieldsStandOneBehindAnotherEachInItsReportAndKind) {
  const HidLayout layout = parse({item(kReport, 3),         item(kPage, 1),         item(kLeast, 0),           item(kMost, 7),
                                  item(kSize, 3),           item(kCount, 2),        item(kUsage, 0x30),        item(kUsage, 0x31),
                                  item(kInput, kVariable),  item(kSize, 5),         item(kCount, 1),           item(kInput, kConstantBits),
                                  item(kSize, 4),           item(kUsage, 0x32),     item(kInput, kVariable),   item(kUsage, 0x33),
                                  item(kOutput, kVariable), item(kUsage, 0x34),     item(kFeature, kVariable), item(kReport, 4),
                                  item(kUsage, 0x35),       item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 6u) << "padding is no field";
  EXPECT_TRUE(layout.numbered);
  const auto at = [&](std::size_t i) { return std::pair{layout.fields[i].bit, layout.fields[i].bits}; };
  EXPECT_EQ(at(0), (std::pair{0u, 3u}));
  EXPECT_EQ(at(1), (std::pair{3u, 3u}));
  EXPECT_EQ(at(2), (std::pair{11u, 4u})) << "behind the padding";
  EXPECT_EQ(at(3), (std::pair{0u, 4u})) << "an output report of its own";
  EXPECT_EQ(at(4), (std::pair{0u, 4u}));
  EXPECT_EQ(at(5), (std::pair{0u, 4u})) << "another report";
  EXPECT_EQ(layout.fields[1].usages, std::vector<HidUsage>{hidUsage(1, 0x31)});
  EXPECT_EQ(layout.fields[4].kind, HidReportKind::Feature);
  EXPECT_EQ(layout.fields[5].report, 4);
  EXPECT_EQ(layout.bytesOf(HidReportKind::Input, 3), 2u) << "15 bits";
  EXPECT_EQ(layout.bytesOf(HidReportKind::Output, 3), 1u);
  EXPECT_EQ(layout.bytesOf(HidReportKind::Input, 4), 1u);
  EXPECT_EQ(layout.bytesOf(HidReportKind::Feature, 4), 0u) << "there is none";
}

TEST(ReportDescriptor, AReportOfWholeBytesHasNoByteMore) {
  const auto bytesOf = [](std::uint32_t bits) {
    return parse({item(kPage, 1), item(kSize, 1), item(kCount, bits), item(kUsage, 0x30), item(kInput, kVariable)})
        .bytesOf(HidReportKind::Input, 0);
  };
  EXPECT_EQ(bytesOf(7), 1u);
  EXPECT_EQ(bytesOf(8), 1u);
  EXPECT_EQ(bytesOf(9), 2u);
}

TEST(ReportDescriptor, WithoutNumbersItSaysSo) {
  EXPECT_FALSE(parse({item(kPage, 1), item(kUsage, 0x30), item(kSize, 8), item(kCount, 1), item(kInput, kVariable)}).numbered);
}

TEST(ReportDescriptor, UsagesOfFourBytesBringTheirPageAndRangesAreCountedUp) {
  const HidLayout layout =
      parse({item(kPage, 9), item(kSize, 1), item(kCount, 3), item(kFirst, 2), item(kLast, 4), item(kInput, kVariable), item(kCount, 1),
             item(kUsage, 0x000F0026, 4), item(kInput, kVariable), item(kUsage, 0x0123, 2), item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 5u);
  for (std::uint16_t i = 0; i < 3; ++i) EXPECT_EQ(layout.fields[i].usages.at(0), hidUsage(9, static_cast<std::uint16_t>(2 + i)));
  EXPECT_EQ(layout.fields[3].usages.at(0), hidUsage(0x0F, 0x26));
  EXPECT_EQ(layout.fields[4].usages.at(0), hidUsage(9, 0x123));
}

TEST(ReportDescriptor, ARangeMayBeToldLastFirstAndOfOneUsage) {
  const HidLayout layout = parse({item(kPage, 9), item(kSize, 1), item(kCount, 2), item(kLast, 8), item(kFirst, 7), item(kInput, kVariable),
                                  item(kCount, 1), item(kFirst, 5), item(kLast, 5), item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 3u);
  EXPECT_EQ(layout.fields[0].usages.at(0), hidUsage(9, 7));
  EXPECT_EQ(layout.fields[1].usages.at(0), hidUsage(9, 8));
  EXPECT_EQ(layout.fields[2].usages, std::vector<HidUsage>{hidUsage(9, 5)});
}

TEST(ReportDescriptor, TheLastUsageIsOfAllThatFollowAndAnArrayListsThem) {
  const HidLayout layout = parse({item(kPage, 1), item(kSize, 8), item(kCount, 3), item(kUsage, 0x30), item(kUsage, 0x31),
                                  item(kInput, kVariable), item(kCount, 2), item(kUsage, 0x40), item(kUsage, 0x41), item(kInput, kArray)});
  ASSERT_EQ(layout.fields.size(), 5u);
  EXPECT_EQ(layout.fields[2].usages, std::vector<HidUsage>{hidUsage(1, 0x31)});
  EXPECT_FALSE(layout.fields[2].array);
  for (const std::size_t i : {3u, 4u}) {
    EXPECT_TRUE(layout.fields[i].array);
    EXPECT_EQ(layout.fields[i].usages, (std::vector<HidUsage>{hidUsage(1, 0x40), hidUsage(1, 0x41)}));
  }
}

TEST(ReportDescriptor, WhatIsLocalEndsWithEveryMainItem) {
  const HidLayout layout =
      parse({item(kPage, 1), item(kSize, 8), item(kCount, 1), item(kUsage, 0x30), item(kInput, kVariable), item(kInput, kVariable),
             item(kFirst, 1), item(kInput, kVariable), item(kLast, 3), item(kInput, kVariable)});
  EXPECT_EQ(layout.fields.size(), 1u) << "a value without a usage is none, and half a range is forgotten";
  EXPECT_EQ(layout.bytesOf(HidReportKind::Input, 0), 4u) << "but each has its place";
}

TEST(ReportDescriptor, CollectionsNestAndAFieldKnowsThemOutermostFirst) {
  const HidLayout layout =
      parse({item(kPage, 1), item(kUsage, 4), item(kUsage, 5), item(kCollection, 1), item(kSize, 8), item(kCount, 1), item(kCollection, 0),
             item(kUsage, 6), item(kCollection, 2), item(kUsage, 0x30), item(kInput, kVariable), item(kEnd, 0, 0), item(kUsage, 0x30),
             item(kOutput, kVariable), item(kEnd, 0, 0), item(kEnd, 0, 0), item(kUsage, 0x31), item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 3u);
  EXPECT_EQ(layout.fields[0].collections, (std::vector<HidUsage>{hidUsage(1, 4), 0, hidUsage(1, 6)})) << "one without a usage is 0";
  EXPECT_EQ(layout.fields[1].collections, (std::vector<HidUsage>{hidUsage(1, 4), 0}));
  EXPECT_TRUE(layout.fields[2].collections.empty());
  const HidUsage x = hidUsage(1, 0x30);
  EXPECT_EQ(layout.find(HidReportKind::Input, x, hidUsage(1, 6)), &layout.fields[0]);
  EXPECT_EQ(layout.find(HidReportKind::Output, x, hidUsage(1, 4)), &layout.fields[1]);
  EXPECT_EQ(layout.find(HidReportKind::Output, x), &layout.fields[1]);
  EXPECT_EQ(layout.find(HidReportKind::Output, x, hidUsage(1, 6)), nullptr);
  EXPECT_EQ(layout.find(HidReportKind::Feature, x), nullptr);
  EXPECT_EQ(layout.find(HidReportKind::Input, hidUsage(2, 0x30)), nullptr) << "another page";
}

TEST(ReportDescriptor, GlobalsAreKeptAndTakenBackAllTogether) {
  const HidLayout layout = parse({item(kPage, 1), item(kLeast, 0xFD), item(kMost, 3), item(kSize, 4), item(kCount, 1), item(kReport, 2),
                                  item(kPush, 0, 0), item(kPage, 9), item(kLeast, 0), item(kMost, 1), item(kSize, 1), item(kCount, 7),
                                  item(kReport, 5), item(kPop, 0, 0), item(kUsage, 0x30), item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 1u);
  const HidField& field = layout.fields[0];
  EXPECT_EQ(field.usages.at(0), hidUsage(1, 0x30));
  EXPECT_EQ(field.least, -3);
  EXPECT_EQ(field.most, 3);
  EXPECT_EQ(field.bits, 4u);
  EXPECT_EQ(field.report, 2);
}

TEST(ReportDescriptor, ItemsThatAreNotKnownArePassedOver) {
  const HidLayout layout = parse({item(kPage, 1), item(0x34, 5), item(0x54, 0xFE), item(0x64, 1), item(0x38, 9), item(0x0C, 7, 2),
                                  item(0xD0, 0), item(kUsage, 0x30), item(kSize, 8), item(kCount, 1), item(kInput, kVariable)});
  ASSERT_EQ(layout.fields.size(), 1u) << "units, physical ranges, designators, reserved ones";
  EXPECT_EQ(layout.fields[0].least, 0);
  EXPECT_EQ(layout.fields[0].most, 0);
}

TEST(ReportDescriptor, WhatIsNoWholeDescriptorIsRefusedInWords) {
  EXPECT_EQ(refusalOf({}), "read");
  EXPECT_EQ(refusalOf({{0xFE, 1, 2, 3}}), "report descriptor: a long item");
  EXPECT_EQ(refusalOf({{0x05}}), "report descriptor: breaks off");
  EXPECT_EQ(refusalOf({{0x06, 1}}), "report descriptor: breaks off");
  EXPECT_EQ(refusalOf({{0x07, 1, 2, 3}}), "report descriptor: breaks off") << "a size of three says four";
  EXPECT_EQ(refusalOf({{0x07, 1, 2, 3, 4}}), "read");
  EXPECT_EQ(refusalOf({item(kCollection, 1)}), "report descriptor: a collection is not closed");
  EXPECT_EQ(refusalOf({item(kEnd, 0, 0)}), "report descriptor: closes a collection that is not open");
  EXPECT_EQ(refusalOf({item(kPop, 0, 0)}), "report descriptor: takes back globals that were not kept");
  EXPECT_EQ(refusalOf({item(kPush, 0, 0), item(kPop, 0, 0), item(kPop, 0, 0)}), "report descriptor: takes back globals that were not kept");
  EXPECT_EQ(refusalOf({item(kFirst, 3), item(kLast, 2)}), "report descriptor: a range of usages");
}

TEST(ReportDescriptor, WhatIsOfUnreasonableSizeIsRefused) {
  EXPECT_EQ(refusalOf({item(kFirst, 1, 2), item(kLast, 4097, 2)}), "read") << "4097 of them";
  EXPECT_EQ(refusalOf({item(kFirst, 1, 2), item(kLast, 4098, 2)}), "report descriptor: a range of usages");
  const auto report = [](std::uint32_t size, std::uint32_t count) {
    return std::vector<Bytes>{item(kSize, size, 4), item(kCount, count, 4), item(kInput, kConstantBits)};
  };
  EXPECT_EQ(refusalOf(report(8, 65'536)), "read") << "64 KiB";
  EXPECT_EQ(refusalOf(report(8, 65'537)), "report descriptor: a report of unreasonable size");
  EXPECT_EQ(refusalOf(report(9, 65'536)), "report descriptor: a report of unreasonable size");
  EXPECT_EQ(refusalOf(report(0, 65'536)), "read");
  EXPECT_EQ(refusalOf(report(0, 65'537)), "report descriptor: a report of unreasonable size");
  EXPECT_EQ(refusalOf(report(0x80000000, 2)), "report descriptor: a report of unreasonable size") << "a product that would wrap to 0";
  std::vector<Bytes> twice = report(8, 40'000);
  twice.push_back(item(kInput, kConstantBits));
  EXPECT_EQ(refusalOf(twice), "report descriptor: a report of unreasonable size") << "together";
}

TEST(ReportDescriptor, AtMost4096FieldsAreKept) {
  const auto many = [](std::uint32_t count) {
    return std::vector<Bytes>{item(kPage, 9), item(kUsage, 1), item(kSize, 1), item(kCount, count, 2), item(kInput, kVariable)};
  };
  EXPECT_EQ(parse(many(4096)).fields.size(), 4096u);
  EXPECT_EQ(refusalOf(many(4097)), "report descriptor: more fields than reasonable");
}

HidField anyField(std::uint32_t bit, std::uint32_t bits, bool isSigned) {
  HidField field;
  field.report = 6;
  field.bit = bit, field.bits = bits;
  if (isSigned) field.least = -1;  // of the range only its sign is meant: most is not more
  field.most = field.least;
  return field;
}

// What is written is read again, at any place and of any length, and no other bit is touched.
TEST(HidFields, AreWrittenAndReadWhereTheyStand) {
  HidLayout numbered;
  numbered.numbered = true;
  std::mt19937 random(3);
  for (std::uint32_t bits = 1; bits <= 32; ++bits)
    for (std::uint32_t bit = 0; bit < 17; ++bit)
      for (const bool isSigned : {false, true})
        for (const int background : {0x00, 0xFF}) {
          const HidField field = anyField(bit, bits, isSigned);
          const auto raw = static_cast<std::uint32_t>(random());
          std::int64_t value = bits == 32 ? raw : raw & ((1u << bits) - 1);
          if (isSigned && (value >> (bits - 1) & 1) != 0) value -= std::int64_t{1} << bits;
          if (!isSigned) value = std::min<std::int64_t>(value, INT32_MAX);
          Bytes report(1 + 8, static_cast<std::uint8_t>(background));
          writeField(field, static_cast<std::int32_t>(value), report);
          ASSERT_EQ(report[0], 6);
          ASSERT_EQ(readField(numbered, field, report), std::optional(static_cast<std::int32_t>(value))) << bits << " at " << bit;
          for (std::uint32_t at = 0; at < 64; ++at) {
            if (at >= bit && at < bit + bits) continue;
            ASSERT_EQ(report[1 + at / 8] >> at % 8 & 1, background & 1) << bits << " at " << bit;
          }
        }
}

TEST(HidFields, AnUnsignedNumberBeyondTheSignedOnesIsTheLargestOfThem) {
  HidLayout plain;
  EXPECT_EQ(readField(plain, anyField(0, 32, false), Bytes{0xFF, 0xFF, 0xFF, 0xFF}), std::optional(INT32_MAX));
  EXPECT_EQ(readField(plain, anyField(0, 32, true), Bytes{0xFE, 0xFF, 0xFF, 0xFF}), std::optional(-2));
}

TEST(HidFields, AReportThatIsTooShortOrOfAnotherNumberHasNoValue) {
  HidLayout plain, numbered;
  numbered.numbered = true;
  const HidField field = anyField(4, 12, false);  // the first two bytes
  EXPECT_EQ(readField(plain, field, Bytes{0x50, 0xAB}), std::optional(0xAB5));
  EXPECT_EQ(readField(plain, field, Bytes{0x50}), std::nullopt);
  EXPECT_EQ(readField(plain, field, Bytes{}), std::nullopt);
  EXPECT_EQ(readField(numbered, field, Bytes{6, 0x50, 0xAB}), std::optional(0xAB5));
  EXPECT_EQ(readField(numbered, field, Bytes{6, 0x50}), std::nullopt);
  EXPECT_EQ(readField(numbered, field, Bytes{5, 0x50, 0xAB}), std::nullopt);
  EXPECT_EQ(readField(numbered, field, Bytes{}), std::nullopt);
}

TEST(HidFields, AReportWithoutRoomIsLeftAsItIs) {
  const HidField field = anyField(4, 12, false);
  Bytes none, tooShort{1, 2}, enough{1, 2, 3};
  writeField(field, 0, none);
  writeField(field, 0, tooShort);
  EXPECT_EQ(tooShort, (Bytes{1, 2}));
  writeField(field, 0, enough);
  EXPECT_EQ(enough, (Bytes{6, 2, 0}));
}

TEST(HidFields, AreHeldToTheirRange) {
  HidField field = anyField(0, 8, true);
  const auto written = [&](std::int32_t value) {
    Bytes report(2);
    writeField(field, value, report);
    return static_cast<int>(static_cast<std::int8_t>(report[1]));
  };
  field.least = -3, field.most = 5;
  EXPECT_EQ(written(6), 5);
  EXPECT_EQ(written(5), 5);
  EXPECT_EQ(written(-3), -3);
  EXPECT_EQ(written(-4), -3);
  field.least = field.most = 5;
  EXPECT_EQ(written(9), 9) << "a range of nothing is none";
}

TEST(HidFields, OfAnArrayAUsageIsItsPlaceInTheListAndOfAVariableItsBit) {
  HidField list = anyField(0, 8, false);
  list.array = true;
  list.usages = {11, 22, 33};
  list.least = 1, list.most = 3;
  const auto chosen = [](const HidField& field, HidUsage usage) {
    Bytes report(2, 0x70);
    writeUsage(field, usage, report);
    return static_cast<int>(report[1]);
  };
  EXPECT_EQ(chosen(list, 11), 1);
  EXPECT_EQ(chosen(list, 33), 3);
  EXPECT_EQ(chosen(list, 44), 0x70) << "it has no such usage";
  HidField bit = anyField(1, 1, false);
  bit.usages = {22};
  EXPECT_EQ(chosen(bit, 22), 0x72);
  EXPECT_EQ(chosen(bit, 11), 0x70);
}

}  // namespace
}  // namespace reachlab::devices
