#include "tests/hidraw/hidraw_bed.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

#include "tests/devices/arm_poses.h"

namespace reachlab::test {
namespace {

std::string hexOf(const HidrawBed::Bytes& bytes) {
  std::string hex;
  for (const std::uint8_t byte : bytes) hex += fmt::format("{:02X}", byte);
  return hex;
}

constexpr const char* kUsb = "/devices/pci0000:00/0000:00:14.0/usb1/1-1";

std::string hidNode(int vendor, int product) { return fmt::format("{}/1-1:1.0/0003:{:04X}:{:04X}.0001", kUsb, vendor, product); }

std::string describe(int node, int vendor, int product, const std::string& serial, const std::string& title,
                     const std::string& descriptor) {
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
      fmt::arg("product", product), fmt::arg("serial", serial), fmt::arg("title", title), fmt::arg("descriptor", descriptor));
}

void require(GError* error) {
  if (error != nullptr) throw std::runtime_error(error->message);
}

}  // namespace

HidrawBed::HidrawBed(int vendor, int product, const std::string& serial, const std::string& title, std::uint8_t reportBytes)
    : vendor_(vendor), product_(product), serial_(serial), title_(title), descriptor_(devices::vendorPage(reportBytes)),
      bed_(umockdev_testbed_new()) {
  plug();
}

// hidapi asks for the descriptor's size and bytes (u32 size, then 4 + 4096 bytes).
gboolean HidrawBed::handleIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self) {
  constexpr unsigned kSize = 1, kDescriptor = 2;
  auto& bed = *static_cast<HidrawBed*>(self);
  const gulong request = umockdev_ioctl_client_get_request(client);
  if (_IOC_TYPE(request) != 'H') return FALSE;
  const unsigned number = _IOC_NR(request);
  GError* error = nullptr;
  UMockdevIoctlData* const data = umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0,
                                                              number == kSize         ? 4
                                                              : number == kDescriptor ? 4 + 4096
                                                                                      : _IOC_SIZE(request),
                                                              &error);
  glong result = -1;
  int code = EPIPE;
  const auto give = [&](gsize at, Bytes bytes) {
    if (!bytes.empty()) umockdev_ioctl_data_update(data, at, bytes.data(), static_cast<gint>(bytes.size()));
  };
  if (error != nullptr || data == nullptr) {
    g_clear_error(&error);
    code = EFAULT;
  } else if (number == kSize || number == kDescriptor) {
    const auto size = static_cast<std::uint32_t>(bed.descriptor_.size());
    give(0, {static_cast<std::uint8_t>(size & 0xFF), static_cast<std::uint8_t>(size >> 8), 0, 0});
    if (number == kDescriptor) give(4, bed.descriptor_);
    else ++bed.opened_;
    result = code = 0;
  }
  umockdev_ioctl_client_complete(client, result, code);
  return TRUE;
}

void HidrawBed::plug() {
  ++node_;
  const std::string path = fmt::format("/dev/hidraw{}", node_);
  GError* error = nullptr;
  umockdev_testbed_add_from_string(bed_, describe(node_, vendor_, product_, serial_, title_, hexOf(descriptor_)).c_str(), &error);
  require(error);
  UMockdevIoctlBase* const ioctls = umockdev_ioctl_base_new();
  g_signal_connect(ioctls, "handle-ioctl", G_CALLBACK(handleIoctl), this);
  umockdev_testbed_attach_ioctl(bed_, path.c_str(), ioctls, &error);
  g_object_unref(ioctls);
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
