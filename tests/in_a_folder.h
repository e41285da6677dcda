#pragma once
#include <gtest/gtest.h>

#include <string>

#include "tests/temporary_folder.h"

namespace reachlab {

/// A test in a new folder, in which nothing has a name yet.
class InAFolder : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const std::string log_ = folder_ / "a_log.reach", data_ = folder_ / "data";
};

}  // namespace reachlab
