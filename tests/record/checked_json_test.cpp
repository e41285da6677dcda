#include "sim/record/configuration/checked_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/fault.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using nlohmann::json;


TEST(CheckedJson, AMemberMustBeThereInAnObject) {
  EXPECT_EQ(memberOf(json{{"a", 5}}, "a"), 5);
  EXPECT_EQ(refusalOf([] { memberOf(json{{"a", 5}}, "b"); }), "b: is missing");
  EXPECT_EQ(refusalOf([] { memberOf(json::array({1}), "b"); }), "b: stands in no object");
}

TEST(CheckedJson, AWholeNumberIsWithinItsBoundsBothIncluded) {
  const auto read = [](const json& value) { return wholeOf(json{{"n", value}}, "n", -3, 7); };
  for (const int good : {-3, 0, 7}) EXPECT_EQ(read(good), good);
  EXPECT_EQ(read(7u), 7);
  const std::string allowed = "; allowed: a whole number from -3 to 7";
  for (const char* bad : {"-4", "8", "7.0", "\"7\"", "null", "true", "9223372036854775807", "9223372036854775808", "18446744073709551615"})
    EXPECT_EQ(refusalOf([&] { read(json::parse(bad)); }), "n: is " + std::string(bad) + allowed);
  EXPECT_EQ(refusalOf([&] { read(json::array({1})); }), "n: is array" + allowed);
  EXPECT_EQ(refusalOf([&] { read(json::object()); }), "n: is object" + allowed);
}

TEST(CheckedJson, AWholeNumberMayBeTheLargestThereIs) {
  const json largest{{"n", std::int64_t{INT64_MAX}}}, larger{{"n", std::uint64_t{INT64_MAX} + 1}};
  EXPECT_EQ(wholeOf(largest, "n", INT64_MIN, INT64_MAX), INT64_MAX);
  EXPECT_EQ(wholeOf(json{{"n", std::uint64_t{INT64_MAX}}}, "n", INT64_MIN, INT64_MAX), INT64_MAX);
  EXPECT_NE(refusalOf([&] { wholeOf(larger, "n", INT64_MIN, INT64_MAX); }), "") << "not as a number below 0";
}

TEST(CheckedJson, ASeedIsAnyNumberOf64Bits) {
  EXPECT_EQ(seedOf(json{{"s", std::uint64_t{UINT64_MAX}}}, "s"), UINT64_MAX);
  EXPECT_EQ(seedOf(json{{"s", 0u}}, "s"), 0u);
  for (const char* bad : {"-1", "1.0", "18446744073709551616", "\"1\""})
    EXPECT_NE(refusalOf([&] {
                seedOf(json{{"s", json::parse(bad)}}, "s");
              }).find("; allowed: a whole number from 0 to 18446744073709551615"),
              std::string::npos)
        << bad;
}

TEST(CheckedJson, ANumberIsWithinItsBoundsBothIncluded) {
  const auto read = [](const json& value) { return numberOf(json{{"x", value}}, "x", -0.5, 2.25); };
  for (const double good : {-0.5, 0.0, 2.25}) EXPECT_EQ(read(good), good);
  EXPECT_EQ(read(2), 2) << "whole ones are numbers";
  for (const double bad : {std::nextafter(-0.5, -1.0), std::nextafter(2.25, 3.0), std::nan("")})
    EXPECT_NE(refusalOf([&] { read(bad); }).find("; allowed: a number from -0.5 to 2.25"), std::string::npos) << bad;
  EXPECT_EQ(refusalOf([&] { read("2"); }), "x: is \"2\"; allowed: a number from -0.5 to 2.25");
}

TEST(CheckedJson, FlagsTextsAndListsAreOfTheirKind) {
  EXPECT_TRUE(flagOf(json{{"f", true}}, "f"));
  EXPECT_FALSE(flagOf(json{{"f", false}}, "f"));
  EXPECT_EQ(refusalOf([] { flagOf(json{{"f", 1}}, "f"); }), "f: is 1; allowed: true or false");
  EXPECT_EQ(textOf(json{{"t", "word"}}, "t"), "word");
  EXPECT_EQ(refusalOf([] { textOf(json{{"t", 1}}, "t"); }), "t: is 1; allowed: a text");
  EXPECT_EQ(listOf(json{{"l", {1, 2, 3}}}, "l", 3).size(), 3u);
  EXPECT_EQ(refusalOf([] { listOf(json{{"l", {1, 2, 3}}}, "l", 2); }), "l: is array; allowed: a list of up to 2");
  EXPECT_EQ(refusalOf([] { listOf(json{{"l", "[]"}}, "l", 2); }), "l: is \"[]\"; allowed: a list of up to 2");
}

TEST(CheckedJson, OfALongTextTheBeginningIsShown) {
  const auto shown = [](std::size_t letters) { return refusalOf([&] { flagOf(json{{"f", std::string(letters, 'a')}}, "f"); }); };
  EXPECT_EQ(shown(38), "f: is \"" + std::string(38, 'a') + "\"; allowed: true or false") << "forty signs with the quotes";
  EXPECT_EQ(shown(39), "f: is \"" + std::string(39, 'a') + " …; allowed: true or false");
}

}  // namespace
}  // namespace reachlab::record
