#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "analysis/conclusions/comparison.h"
#include "analysis/conclusions/progress_model.h"

namespace reachlab::analysis {
namespace {

// People who succeed in 3, 5 and 12 of 20 trials of three conditions, and up to two more each.
TEST(Effects, OfConditionsAreCorrectedTogetherByHolm) {
  constexpr int kSuccesses[] = {3, 5, 12};
  std::vector<Attempt> attempts;
  for (std::size_t condition = 0; condition < 3; ++condition)
    for (int person = 0; person < 5; ++person)
      for (int trial = 0; trial < 20; ++trial)
        attempts.push_back(
            {std::string(1, static_cast<char>('a' + person)), "1", 1, condition, trial < kSuccesses[condition] + person % 3});
  std::vector<double> own, told;
  for (const Effect& effect : effectsOf(successTable(attempts), 3))
    if (!effect.ofDay) own.push_back(effect.logit.p), told.push_back(effect.p);
  ASSERT_EQ(own.size(), 3u);
  EXPECT_EQ(told, adjustByHolm(own));
  const auto least = static_cast<std::size_t>(std::min_element(own.begin(), own.end()) - own.begin());
  EXPECT_LT(own[least], 0.3);
  EXPECT_DOUBLE_EQ(told[least], 3 * own[least]) << "the smallest of three counts thrice";
}

}  // namespace
}  // namespace reachlab::analysis
