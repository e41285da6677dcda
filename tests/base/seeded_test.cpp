#include "base/math/seeded.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math/philox.h"

namespace reachlab {
namespace {

// SplitMix64 of seed s gives mixBits(s), mixBits(s + g), …: the numbers of Steele's own program.
TEST(Seeded, MixesAsSplitMix64Does) {
  constexpr std::uint64_t kGamma = 0x9e3779b97f4a7c15;
  EXPECT_EQ(mixBits(0), 0xe220a8397b1dcdafu);
  EXPECT_EQ(mixBits(kGamma), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(mixBits(1234567), 6457827717110365317u);
  EXPECT_EQ(mixBits(1234567 + kGamma), 3203168211198807973u);
}

TEST(Seeded, ALabelHashesAsFnv1aHasIt) {
  EXPECT_EQ(hashOf(""), 0xcbf29ce484222325u);
  EXPECT_EQ(hashOf("a"), 0xaf63dc4c8601ec8cu);
  EXPECT_EQ(hashOf("foobar"), 0x85944171f73967e8u);
}

TEST(Seeded, FractionsAreSpreadOverTheUnitInterval) {
  double least = 1, most = 0, sum = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    const double x = seededFraction(3, i);
    least = std::min(least, x), most = std::max(most, x), sum += x;
    EXPECT_EQ(x, std::ldexp(static_cast<double>(seededBits(3, i) / 2048), -53)) << "its upper 53 bits";
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(least, 1e-3);
  EXPECT_GT(most, 1 - 1e-3);
  EXPECT_LT(most, 1);
  EXPECT_NEAR(sum / 10'000, 0.5, 0.015) << "five standard deviations";
}

// Numbers that a recording holds: another mix would draw other trials of the same seed.
TEST(Seeded, DrawsTheNumbersThatItAlwaysDrew) {
  EXPECT_EQ(seededBits(7, 2), mixBits(mixBits(7) ^ mixBits(~std::uint64_t{2})));
  EXPECT_NE(seededBits(7, 2), seededBits(2, 7));
  EXPECT_NE(seededBits(7, 2), seededBits(7, 3));
}

// The known answers that the authors publish with Random123 (kat_vectors: philox4x32, 10 rounds).
TEST(Philox, GivesItsAuthorsKnownAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

}  // namespace
}  // namespace reachlab
