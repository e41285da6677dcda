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
  std::error_code error;
  const auto add = [&](const std::filesystem::path& path, const std::string& state) {
    sum += std::hash<std::string>{}(path.string() + ' ' + state);
  };
  for (const char* folder : {"/dev", "/dev/input"})
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (struct stat node{}; isOurs(entry.path().filename().string()) && ::stat(entry.path().c_str(), &node) == 0)
        add(entry.path(), std::to_string(node.st_ctim.tv_sec) + ' ' + std::to_string(node.st_ctim.tv_nsec));
  // What vendors' libraries drive shows here only, bus by bus. Asking for a device must not look like a change, so its times do not count.
  for (const auto& bus : std::filesystem::directory_iterator("/dev/bus/usb", error))
    for (const auto& entry : std::filesystem::directory_iterator(bus.path(), error))
      if (struct stat node{}; ::stat(entry.path().c_str(), &node) == 0)
        add(entry.path(), std::to_string(node.st_ino) + ' ' + std::to_string(node.st_mode));
  return sum;
}

std::vector<FoundDevice> findPlugged() {
  std::vector<FoundDevice> found;
  for (const char* kind : {"hid", "spacemouse", "polhem", "tablet"}) {
    const DeviceDriver* driver = findDriver(kind);
    if (driver == nullptr) continue;
    for (FoundDevice& device : driver->find(*driver))
      if (device.present) found.push_back(std::move(device));
  }
  return found;
}

}  // namespace reachlab::devices
