#include "tests/devices/fakes/fake_hidapi.h"

#include <hidapi/hidapi.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <thread>
#include <utility>

#include "devices/hid/report_descriptor.h"

namespace reachlab::test {
namespace {

FakeHids hids;

FakeHid* byPath(const std::string& path) {
  const auto at = std::find_if(hids.list.begin(), hids.list.end(), [&](const FakeHid& hid) { return hid.path == path; });
  return at == hids.list.end() ? nullptr : &*at;
}
FakeHid& of(hid_device* device) { return *reinterpret_cast<FakeHid*>(device); }
wchar_t* textOf(std::wstring& text) { return text.empty() ? nullptr : text.data(); }

std::vector<std::uint8_t> readFake(const std::string& node);
std::vector<std::uint8_t> (*const readFromSystem)(const std::string&) = std::exchange(devices::readSystemDescriptor, readFake);
std::vector<std::uint8_t> readFake(const std::string& node) {
  const std::lock_guard lock(hids.mutex);
  const FakeHid* hid = byPath(node);
  return hid == nullptr ? readFromSystem(node) : hid->descriptor;
}

}  // namespace

FakeHids& fakeHids() { return hids; }
void resetFakeHids(const std::vector<FakeHid>& list) {
  const std::lock_guard lock(hids.mutex);
  hids.list.assign(list.begin(), list.end());
}
void setFirstFakeHid(bool gone, const std::deque<std::vector<std::uint8_t>>& reports) {
  const std::lock_guard lock(hids.mutex);
  hids.list.front().gone = gone;
  hids.list.front().reports = reports;
}
FakeHid& resetToOneFakeHid() {
  resetFakeHids({{.path = "/dev/hidraw3", .paces = false}});
  return hids.list.front();
}

}  // namespace reachlab::test

using namespace reachlab::test;

extern "C" {

int __real_access(const char* path, int how);
int __wrap_access(const char* path, int how) {
  const std::lock_guard lock(hids.mutex);
  const FakeHid* hid = byPath(path);
  if (hid == nullptr) return __real_access(path, how);
  errno = hid->closedBy;
  return hid->closedBy == 0 ? 0 : -1;
}

hid_device_info* hid_enumerate(unsigned short vendor, unsigned short product) {
  const std::lock_guard lock(hids.mutex);
  hid_device_info* first = nullptr;
  hid_device_info** end = &first;
  for (FakeHid& hid : hids.list) {
    if (hid.gone || (vendor != 0 && vendor != hid.vendor) || (product != 0 && product != hid.product)) continue;
    *end = new hid_device_info{};
    (*end)->path = hid.path.data();
    (*end)->vendor_id = hid.vendor, (*end)->product_id = hid.product;
    (*end)->serial_number = textOf(hid.serial);
    (*end)->manufacturer_string = textOf(hid.maker);
    (*end)->product_string = textOf(hid.title);
    end = &(*end)->next;
  }
  return first;
}
void hid_free_enumeration(hid_device_info* list) {
  while (list != nullptr) {
    hid_device_info* const next = list->next;
    delete list;
    list = next;
  }
}
hid_device* hid_open_path(const char* path) {
  const std::lock_guard lock(hids.mutex);
  FakeHid* hid = byPath(path);
  if (hid == nullptr || hid->gone || hid->closedBy != 0) return nullptr;
  ++hid->open, ++hid->opened;
  return reinterpret_cast<hid_device*>(hid);
}
void hid_close(hid_device* device) {
  const std::lock_guard lock(hids.mutex);
  if (device != nullptr) --of(device).open;
}
// A steady report is one a turn: what asks without waiting has just had it.
int hid_read_timeout(hid_device* device, unsigned char* data, size_t length, int milliseconds) {
  std::vector<std::uint8_t> report;
  bool paced = milliseconds > 0;
  {
    const std::lock_guard lock(hids.mutex);
    FakeHid& hid = of(device);
    if (hid.waits.size() < 1000) hid.waits.push_back(milliseconds);
    hid.room = length;
    paced = paced && hid.paces;
    if (hid.gone) return -1;
    if (!hid.reports.empty()) {
      report = hid.reports.front();
      hid.reports.pop_front();
      paced = false;
    } else if (paced) {
      report = hid.steady;
    }
  }
  if (paced) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::size_t count = std::min(report.size(), length);
  std::copy_n(report.begin(), count, data);
  return static_cast<int>(count);
}
int hid_write(hid_device* device, const unsigned char* data, size_t length) {
  const std::lock_guard lock(hids.mutex);
  FakeHid& hid = of(device);
  if (hid.gone || hid.deaf) return -1;
  hid.written.emplace_back(data, data + length);
  return static_cast<int>(length);
}
const wchar_t* hid_error(hid_device*) { return L"the library\u2019s own words"; }
}
