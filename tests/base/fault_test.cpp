#include "base/fault.h"

#include <gtest/gtest.h>

#include <functional>

#include "base/names.h"
#include "base/number_range.h"
#include "tests/refusal.h"

namespace reachlab {
namespace {

TEST(Fault, IsToldWithoutWhatIsNotThere) {
  EXPECT_EQ(toText(Fault{"mass_kg", "is -1", "more than 0 kg", FilePlace{"study.json", 3, 7}}),
            "study.json:3:7: mass_kg: is -1; allowed: more than 0 kg");
  EXPECT_EQ(toText(Fault{"mass_kg", "is -1", "", FilePlace{"study.json", 3, 0}}), "study.json:3: mass_kg: is -1");
  EXPECT_EQ(toText(Fault{"", "is empty", "", FilePlace{"study.json"}}), "study.json: is empty");
  EXPECT_EQ(toText(Fault{"", "is empty", "", FilePlace{"study.json", 0, 4}}), "study.json: is empty") << "no column without its line";
  EXPECT_EQ(toText(Fault{"", "is empty"}), "is empty");
  EXPECT_EQ(toText(Fault{"mass_kg", "is -1"}), "mass_kg: is -1");
  EXPECT_EQ(toText(Fault{"curve[1]", "ends", "", FilePlace{"", 1, 5}}), "curve[1], character 5: ends");
  EXPECT_EQ(toText(Fault{"", "ends", "a term", FilePlace{"", 1, 5}}), "character 5: ends; allowed: a term");
}

TEST(Fault, SeveralAreALineEach) {
  EXPECT_EQ(toText(std::vector<Fault>{}), "");
  EXPECT_EQ(toText({Fault{"a", "is 1"}, Fault{"b", "is 2"}, Fault{"c", "is 3"}}), "a: is 1\nb: is 2\nc: is 3");
  const FaultError error(std::vector{Fault{"a", "is 1"}, Fault{"b", "is 2"}});
  EXPECT_STREQ(error.what(), "a: is 1\nb: is 2");
  EXPECT_EQ(error.faults.size(), 2u);
}

TEST(Fault, IsToldFromOutside) {
  EXPECT_EQ(keyIn("constraint", "shape"), "constraint.shape");
  EXPECT_EQ(keyIn("", "shape"), "shape");
  const std::vector<Fault> told = inside("trials[3]", {Fault{"index", "is 1"}, Fault{"", "is empty"}});
  EXPECT_EQ(told[0].key, "trials[3].index");
  EXPECT_EQ(told[1].key, "trials[3]");
  const std::vector<Fault> placed = inFile("new.json", {Fault{"a", "is 1"}, Fault{"b", "is 2", "", FilePlace{"old.json", 2, 3}}});
  EXPECT_EQ(placed[0].place, (FilePlace{"new.json", 0, 0}));
  EXPECT_EQ(placed[1].place, (FilePlace{"old.json", 2, 3}));
}

TEST(Fault, OfATextWithinATextIsToldByItsKeyAlone) {
  const auto refused = [] {
    underKey("change", [] { throw FaultError(Fault{"mass_kg", "is -1", "more than 0 kg", FilePlace{"", 2, 3}}); });
  };
  EXPECT_EQ(refusalOf(refused), "change.mass_kg: is -1; allowed: more than 0 kg") << "its line is none of the file's";
}

TEST(Names, TheNearestIsTheOneOfLeastEdits) {
  EXPECT_EQ(nearestName("elipse", {"circle", "ellipse", "eclipse"}), "ellipse");
  EXPECT_EQ(nearestName("cat", {"bat", "rat"}), "bat") << "the first of equals";
  const std::string front = "a-name-of-some-length-";
  EXPECT_EQ(nearestName(front + "kitten", {front + "sitting", front + "kiabcd"}), front + "sitting") << "3 edits, not 4";
  EXPECT_EQ(nearestName(front + "sitting", {front + "sIttiXY", front + "kitten"}), front + "sIttiXY") << "3 edits, too";
  EXPECT_EQ(nearestName(front + "saturday", {front + "sunday", front + "saturXYZW"}), front + "sunday") << "3 edits, not 4";
}

TEST(Names, OfAFileAreWhatIsBeforeItsJson) {
  for (const char* file : {"lab/chain.v2.json", "chain.v2.json", "lab/chain.v2", "chain.v2"})
    EXPECT_EQ(nameOfFile(file), "chain.v2") << file;
  EXPECT_EQ(nameOfFile("chain-moderate"), "chain-moderate");
}

TEST(Names, NoneIsNearThatIsTooFar) {
  EXPECT_EQ(nearestName("", {"a"}), "");
  EXPECT_EQ(nearestName("abc", {}), "");
  EXPECT_EQ(nearestName("a", {"b"}), "");
  EXPECT_EQ(nearestName("a", {"a"}), "a");
  EXPECT_EQ(nearestName("ab", {"ax"}), "ax");
  EXPECT_EQ(nearestName("ab", {"xy"}), "") << "nothing of it is left";
  EXPECT_EQ(nearestName("abcd", {"abxy"}), "abxy");
  EXPECT_EQ(nearestName("abcd", {"axyz"}), "");
  EXPECT_EQ(nearestName("abcdefgh", {"abcdexyz"}), "") << "a third of eight is two";
  EXPECT_EQ(nearestName("abcdefghi", {"abcdefxyz"}), "abcdefxyz");
  EXPECT_EQ(nearestName("abcdefghi", {"abcdewxyz"}), "");
  EXPECT_EQ(nearestName(std::string(60, 'a'), {std::string(59, 'a')}), std::string(59, 'a'));
  EXPECT_EQ(nearestName(std::string(61, 'a'), {std::string(60, 'a')}), "") << "nobody typed that";
}

TEST(Names, AreListedAsInASentence) {
  EXPECT_EQ(listOf({}), "");
  EXPECT_EQ(listOf({"a"}), "a");
  EXPECT_EQ(listOf({"a", "b"}), "a or b");
  EXPECT_EQ(listOf({"a", "b", "c"}), "a, b or c");
}

TEST(NumberRange, EachHoldsWhatItsWordsSay) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min(), kMost = std::numeric_limits<double>::max();
  const auto expect = [](const NumberRange& range, const std::string& words, std::vector<double> inside, std::vector<double> outside) {
    EXPECT_EQ(range.allowed, words);
    for (const double value : inside) EXPECT_TRUE(isWithin(range, value)) << words << ": " << value;
    outside.push_back(std::numeric_limits<double>::infinity());
    outside.push_back(-std::numeric_limits<double>::infinity());
    outside.push_back(std::numeric_limits<double>::quiet_NaN());
    for (const double value : outside) EXPECT_FALSE(isWithin(range, value)) << words << ": " << value;
  };
  expect(anyNumber(), "any finite number", {-kMost, 0, kMost, 0.5}, {});
  expect(positive("kg"), "more than 0 kg", {kLeast, 0.5, kMost}, {0, -kLeast});
  expect(wholeNumber(2, 5), "a whole number from 2 to 5", {2, 3, 5}, {1, 6, 2.5, 4.999});
  expect(positiveUpTo(3, "s"), "more than 0 s, at most 3 s", {kLeast, 2.5, 3}, {0, 3.001});
  expect({.lo = 1, .hi = 2, .allowed = "1 to 2"}, "1 to 2", {1, 1.5, 2}, {0.999, 2.001});
}

std::string toldOf(const std::function<void(std::vector<Fault>&)>& check) {
  std::vector<Fault> faults;
  check(faults);
  return toText(faults);
}

TEST(NumberRange, WhatIsOutsideIsToldUnderItsKey) {
  EXPECT_EQ(toldOf([](auto& f) { checkNumber("m", 0, positive("kg"), f); }), "m: is 0; allowed: more than 0 kg");
  EXPECT_EQ(toldOf([](auto& f) { checkNumber("m", 1, positive("kg"), f); }), "");
  const auto numbers = [](const std::vector<double>& values, int count) {
    return toldOf([&](auto& f) { checkNumbers("m", values, count, positive("kg"), f); });
  };
  EXPECT_EQ(numbers({1, 2}, 2), "");
  EXPECT_EQ(numbers({1, -2, 3, -4}, -1), "m[1]: is -2; allowed: more than 0 kg\nm[3]: is -4; allowed: more than 0 kg");
  EXPECT_EQ(numbers({}, 0), "");
  EXPECT_EQ(numbers({1}, 0), "m: has 1 element; allowed: an array of 0 numbers");
  EXPECT_EQ(numbers({1, 2}, 1), "m: has 2 elements; allowed: an array of 1 number");
  EXPECT_EQ(toldOf([](auto& f) { checkChoice("c", "x", {"a", "b"}, f); }), "c: is \"x\"; allowed: a or b");
  EXPECT_EQ(toldOf([](auto& f) { checkChoice("c", "b", {"a", "b"}, f); }), "");
}

}  // namespace
}  // namespace reachlab
