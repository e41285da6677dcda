#pragma once
#include <umockdev.h>

#include <string>

namespace reachlab::test {

/// A HID device that the system shows to this program and its children, without hardware: run under umockdev-wrapper. What the device
/// says and hears goes through `wire`, a descriptor without report boundaries: keep one report in flight.
class HidrawBed {
 public:
  HidrawBed(int vendor, int product, const std::string& serial, const std::string& title);
  ~HidrawBed();
  HidrawBed(const HidrawBed&) = delete;
  HidrawBed& operator=(const HidrawBed&) = delete;

  int wire() const { return wire_; }
  /// The cable is pulled; `plug` puts it in again.
  void unplug();
  void plug();

 private:
  int vendor_, product_;
  std::string serial_, title_;
  UMockdevTestbed* bed_;
  int wire_ = -1;
  int node_ = -1;  // of /dev/hidraw; a new one each time, as the system gives
};

}  // namespace reachlab::test
