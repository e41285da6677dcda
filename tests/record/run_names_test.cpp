#include "sim/record/log/run_names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace reachlab::record {
namespace {

TEST(LabelOrder, IsThatOfNumbersBeforeThatOfLetters) {
  std::vector<std::string> labels{"post", "10", "9", "002", "1a", "01", "1", "pre", "99999999999999999999999"};
  std::sort(labels.begin(), labels.end(), labelBefore);
  EXPECT_EQ(labels, (std::vector<std::string>{"01", "1", "002", "9", "10", "99999999999999999999999", "1a", "post", "pre"}));
}

TEST(RunOrder, IsThatOfRecordingWhateverTheTaskIsCalled) {
  const auto name = [](const char* subject, const char* session, const char* task, const char* run) {
    return "d/sub-" + std::string(subject) + "_ses-" + session + "_task-" + task + "_run-" + run + "_log.reach";
  };
  const std::vector<std::string> order{name("01", "9", "zreach", "01"),  name("01", "9", "areach", "02"),
                                       name("01", "9", "areach", "99"),  name("01", "9", "areach", "100"),
                                       name("01", "10", "areach", "01"), name("02", "01", "areach", "01")};
  std::vector<std::string> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_NE(sorted, order);
  std::sort(sorted.begin(), sorted.end(), runBefore);
  EXPECT_EQ(sorted, order);
}

}  // namespace
}  // namespace reachlab::record
