#include "tests/hidraw/hidraw_bed.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace reachlab::test {
namespace {

// Vendor page, one collection, 64 bytes in and out without report numbers.
constexpr const char* kDescriptor = "06ABFF0A0002A101150026FF0075089540090181020902954091 02C0";

std::string descriptor() {
  std::string hex;
  for (const char* c = kDescriptor; *c != 0; ++c)
    if (*c != ' ') hex += *c;
  return hex;
}

constexpr const char* kUsb = "/devices/pci0000:00/0000:00:14.0/usb1/1-1";

std::string hidNode(int vendor, int product) { return fmt::format("{}/1-1:1.0/0003:{:04X}:{:04X}.0001", kUsb, vendor, product); }

std::string describe(int node, int vendor, int product, const std::string& serial, const std::string& title) {
  const std::string hid = hidNode(vendor, product);
  return fmt::format(
      "P: {hid}/hidraw/hidraw{node}\nN: hidraw{node}\nE: DEVNAME=/dev/hidraw{node}\nE: MAJOR=240\nE: MINOR={node}\nE: SUBSYSTEM=hidraw\n"
      "L: device=../../../0003:{vendor:04X}:{product:04X}.0001\nA: dev=240:{node}\\n\n\n"
      "P: {hid}\nE: DRIVER=hid-generic\nE: HID_ID=0003:0000{vendor:04X}:0000{product:04X}\nE: HID_NAME={title}\n"
      "E: HID_PHYS=usb-0000:00:14.0-1/input0\nE: HID_UNIQ={serial}\nE: MODALIAS=hid:b0003g0001v0000{vendor:04X}p0000{product:04X}\n"
      "E: SUBSYSTEM=hid\nH: report_descriptor={descriptor}\n\n"
      "P: {usb}/1-1:1.0\nE: DEVTYPE=usb_interface\nE: DRIVER=usbhid\nE: INTERFACE=3/0/0\nE: SUBSYSTEM=usb\nA: bInterfaceNumber=00\\n\n\n"
      "P: {usb}\nN: bus/usb/001/{usbNode:03}\nE: DEVNAME=/dev/bus/usb/001/{usbNode:03}\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: "
      "MAJOR=189\nE: MINOR=1\n"
      "E: SUBSYSTEM=usb\nA: idVendor={vendor:04x}\\n\nA: idProduct={product:04x}\\n\nA: bcdDevice=0100\\n\nA: manufacturer=Lab\\n\n"
      "A: product={title}\\n\nA: serial={serial}\\n\n",
      fmt::arg("hid", hid), fmt::arg("node", node), fmt::arg("usbNode", node + 2), fmt::arg("usb", kUsb), fmt::arg("vendor", vendor),
      fmt::arg("product", product), fmt::arg("serial", serial), fmt::arg("title", title), fmt::arg("descriptor", descriptor()));
}

void require(GError* error) {
  if (error != nullptr) throw std::runtime_error(error->message);
}

}  // namespace

HidrawBed::HidrawBed(int vendor, int product, const std::string& serial, const std::string& title)
    : vendor_(vendor), product_(product), serial_(serial), title_(title), bed_(umockdev_testbed_new()) {
  plug();
}

void HidrawBed::plug() {
  ++node_;
  const std::string path = fmt::format("/dev/hidraw{}", node_);
  GError* error = nullptr;
  umockdev_testbed_add_from_string(bed_, describe(node_, vendor_, product_, serial_, title_).c_str(), &error);
  require(error);
  // hidapi asks for the descriptor's size and bytes: u32 size, then 4 + 4096 bytes.
  const std::string hex = descriptor(), size = fmt::format("{:02X}000000", hex.size() / 2);
  char name[] = "/tmp/hidraw-ioctl-XXXXXX";
  const int file = mkstemp(name);
  const std::string script = fmt::format("@DEV {3}\nHIDIOCGRDESCSIZE 0 {0}\nHIDIOCGRDESC 0 {0}{1}{2}\n", size, hex,
                                         std::string((4096 - hex.size() / 2) * 2, '0'), path);
  if (file < 0 || ::write(file, script.data(), script.size()) != static_cast<ssize_t>(script.size())) throw std::runtime_error(name);
  ::close(file);
  umockdev_testbed_load_ioctl(bed_, path.c_str(), name, &error);
  ::unlink(name);
  require(error);
  wire_ = umockdev_testbed_get_dev_fd(bed_, path.c_str());
}

void HidrawBed::unplug() {
  umockdev_testbed_clear(bed_);
  if (wire_ >= 0) ::close(wire_);
  wire_ = -1;
}

HidrawBed::~HidrawBed() {
  if (wire_ >= 0) ::close(wire_);
  g_object_unref(bed_);
}

}  // namespace reachlab::test
