#pragma once
#include <umockdev.h>

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab::test {

/// A HID device that the system shows to this program and its children, without hardware: run under umockdev-wrapper. What the device
/// says and hears goes through `wire`, a descriptor without report boundaries: keep one report in flight.
class HidrawBed {
 public:
  using Bytes = std::vector<std::uint8_t>;
  /// Its reports have so many bytes, in and out.
  HidrawBed(int vendor, int product, const std::string& serial, const std::string& title, std::uint8_t reportBytes = 64);
  ~HidrawBed();
  HidrawBed(const HidrawBed&) = delete;
  HidrawBed& operator=(const HidrawBed&) = delete;

  int wire() const { return wire_; }
  /// How often it was opened so far, by whatever program.
  const std::atomic<int>& opened() const { return opened_; }
  /// The cable is pulled; `plug` puts it in again.
  void unplug();
  void plug();

 private:
  static gboolean handleIoctl(UMockdevIoctlBase* base, UMockdevIoctlClient* client, gpointer self);
  int vendor_, product_;
  std::string serial_, title_;
  Bytes descriptor_;
  UMockdevTestbed* bed_;
  int wire_ = -1;
  std::atomic<int> opened_{0};
  int node_ = -1;  // of /dev/hidraw; a new one each time, as the system gives
};

}  // namespace reachlab::test
