#pragma once
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/input/event_node.h"

namespace reachlab::test {

/// What the kernel says of event nodes when it is asked (linux/input.h): any file can stand for one.
struct FakeInput {
  std::string name = {};
  std::vector<int> keys = {}, axes = {};
  std::map<int, devices::InputAxis> ranges = {};  // of axes; others are not told
};
struct FakeInputs {
  std::mutex mutex;
  std::map<std::string, FakeInput> nodes;                                 // by their paths
  std::optional<std::vector<devices::TabletNode>> listed = std::nullopt;  // instead of /dev/input
};
FakeInputs& fakeInputs();

}  // namespace reachlab::test
