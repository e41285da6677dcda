#include "devices/hid/hid_port.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/error.h"
#include "base/system/hold_alone.h"

namespace reachlab::devices {
namespace {

// HID strings of devices are ASCII; anything else is shown as a question mark.
std::string narrow(const wchar_t* text) {
  std::string out;
  for (; text != nullptr && *text != 0; ++text) out += *text >= 0x20 && *text < 0x7F ? static_cast<char>(*text) : '?';
  return out;
}

}  // namespace

std::vector<HidInterface> findHid(std::uint16_t vendor, std::uint16_t product) {
  std::vector<HidInterface> found;
  hid_device_info* const list = hid_enumerate(vendor, product);
  for (const hid_device_info* at = list; at != nullptr; at = at->next)
    found.push_back({at->path != nullptr ? at->path : "", at->vendor_id, at->product_id, narrow(at->serial_number),
                     narrow(at->manufacturer_string), narrow(at->product_string)});
  hid_free_enumeration(list);
  std::sort(found.begin(), found.end(), [](const HidInterface& a, const HidInterface& b) { return a.path < b.path; });
  return found;
}

const HidInterface* chooseHid(const std::vector<HidInterface>& interfaces, const std::string& key) {
  for (const HidInterface& at : interfaces)
    if (key.empty() || at.key() == key || at.path == key) return &at;
  return nullptr;
}

std::string whyNotOpen(const HidInterface& interface) {
  if (::access(interface.path.c_str(), R_OK | W_OK) == 0) return {};
  const int error = errno;
  const char* remedy = error == EACCES || error == EPERM ? "; install packaging/udev/70-reachlab.rules and plug it in again" : "";
  return fmt::format("{}: {}{}", interface.path, std::strerror(error), remedy);
}

HidPort::HidPort(const HidInterface& interface)
    : alone_(::open(interface.path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), device_(nullptr) {
  if (alone_ >= 0) os::holdAlone(alone_, interface.path);
  device_ = hid_open_path(interface.path.c_str());
  if (device_ != nullptr) return;
  const std::string why = whyNotOpen(interface);
  throw ResourceError(fmt::format("{}: {}", interface.path, why.empty() ? narrow(hid_error(nullptr)) : why));
}

HidPort::~HidPort() { hid_close(device_); }

int HidPort::read(std::span<std::uint8_t> bytes, int milliseconds) noexcept {
  return hid_read_timeout(device_, bytes.data(), bytes.size(), milliseconds);
}

bool HidPort::write(std::span<const std::uint8_t> bytes) noexcept { return hid_write(device_, bytes.data(), bytes.size()) >= 0; }

}  // namespace reachlab::devices
