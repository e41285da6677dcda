#include "tests/devices/fakes/fake_input.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <filesystem>
#include <utility>

namespace reachlab::test {
namespace {

using devices::TabletNode;

FakeInputs inputs;

std::optional<FakeInput> nodeOf(int file) {
  std::error_code error;
  const std::string path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), error);
  const std::lock_guard lock(inputs.mutex);
  const auto at = inputs.nodes.find(path);
  return at == inputs.nodes.end() ? std::nullopt : std::optional(at->second);
}

int answer(const FakeInput& node, unsigned long request, void* argument) {
  const unsigned number = _IOC_NR(request), size = _IOC_SIZE(request);
  auto* bytes = static_cast<unsigned char*>(argument);
  if (number == _IOC_NR(EVIOCGNAME(0))) {
    const std::size_t count = std::min<std::size_t>(node.name.size() + 1, size);
    std::memcpy(bytes, node.name.c_str(), count);
    return static_cast<int>(count);
  }
  if (number == 0x20 + EV_KEY || number == 0x20 + EV_ABS) {
    for (const int bit : number == 0x20 + EV_KEY ? node.keys : node.axes) {
      const auto at = static_cast<unsigned>(bit);
      if (at / 8 < size) bytes[at / 8] = static_cast<unsigned char>(bytes[at / 8] | 1u << at % 8);
    }
    return static_cast<int>(size);
  }
  const auto range = number >= 0x40 ? node.ranges.find(static_cast<int>(number - 0x40)) : node.ranges.end();
  if (range == node.ranges.end()) return errno = EINVAL, -1;
  auto* info = static_cast<input_absinfo*>(argument);
  info->minimum = range->second.least, info->maximum = range->second.most, info->resolution = range->second.perMm;
  return 0;
}

std::vector<TabletNode> (*const listOfSystem)() = std::exchange(devices::listTablets, [] {
  {
    const std::lock_guard lock(inputs.mutex);
    if (inputs.listed) return *inputs.listed;
  }
  return listOfSystem();
});

}  // namespace

FakeInputs& fakeInputs() { return inputs; }

}  // namespace reachlab::test

using namespace reachlab::test;

extern "C" {

int __real_ioctl(int file, unsigned long request, ...);
int __wrap_ioctl(int file, unsigned long request, ...) {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (_IOC_TYPE(request) == 'E')
    if (const auto node = nodeOf(file)) return answer(*node, request, argument);
  return __real_ioctl(file, request, argument);
}
}
