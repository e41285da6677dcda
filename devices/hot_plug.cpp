#include "devices/hot_plug.h"

#include <sys/stat.h>

#include <filesystem>
#include <string>

namespace reachlab::devices {
namespace {

bool isOurs(const std::string& name) { return name.starts_with("hidraw") || name.starts_with("ttyACM") || name.starts_with("event"); }

}  // namespace

std::uint64_t pluggedFingerprint() {
  std::uint64_t sum = 0;  // order does not count: the system lists as it likes
  for (const char* folder : {"/dev", "/dev/input"}) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      struct stat node {};
      if (!isOurs(name) || ::stat(entry.path().c_str(), &node) != 0) continue;
      sum += std::hash<std::string>{}(name + ' ' + std::to_string(node.st_ctim.tv_sec) + ' ' + std::to_string(node.st_ctim.tv_nsec));
    }
  }
  return sum;
}

std::vector<FoundDevice> findPlugged() {
  std::vector<FoundDevice> found;
  for (const char* kind : {"hid", "spacemouse", "polhem", "stick", "keyboard", "gamepad", "tablet"}) {
    const DeviceDriver* driver = findDriver(kind);
    if (driver == nullptr) continue;
    for (FoundDevice& device : driver->find(*driver))
      if (device.present) found.push_back(std::move(device));
  }
  return found;
}

}  // namespace reachlab::devices
