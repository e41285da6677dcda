#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The input from which a driver makes a device: NAME:ARGUMENT and the run.
struct DeviceRequest {
  std::string name, argument;  // argument: the text behind the colon, empty without a colon
  const experiment::CompiledExperiment& experiment;
  std::uint64_t seed = 0;
  std::shared_ptr<void>* learnt = nullptr;  // by the same virtual person in other scenes (MakeSubject); null: nothing
  /// The name in messages: "device phantom:Left".
  std::string words() const { return "device " + name + (argument.empty() ? "" : ":" + argument); }
};

/// One row of `reach list devices`: a device that is present, under the name that opens it. A kind without a present device has one row.
struct FoundDevice {
  std::string name;
  std::string kind;  // the driver's name
  std::string description;
  bool present = false;
  std::string whyNot;  // the reason as the loader, the system or the device tells it, with the remedy; empty when the device is present
  std::optional<int> degreesOfFreedom;
  std::optional<double> maxForce, continuousForce;  // [N]; 0: the device renders no force
  std::optional<double> rate;                       // [1/s]
};

/// One kind of device. A new driver is a file that makes one of these entries, and a line in registry.cpp. `reach list devices`, the help
/// texts and the window read the entries there.
struct DeviceDriver {
  std::string name;         // "phantom"
  std::string usage;        // "phantom[:NAME]"
  std::string description;  // one line
  /// The devices of this kind, or one row with the reason why there is no device. Opens as few devices as possible and leaves every device
  /// as it was.
  std::vector<FoundDevice> (*find)(const DeviceDriver& self);
  /// Throws FaultError (a wrong argument) or ResourceError (the device cannot be opened).
  std::unique_ptr<haptics::HapticDevice> (*make)(const DeviceRequest& request);
  bool isMade = false;            // by this program: as many exist as are asked for
  bool inWindowOnly = false;      // it cannot be opened by `make`
  bool takesHandSettings = true;  // the options of every device, such as a mapping
};

/// Every driver of this program, in the order of lists.
std::span<const DeviceDriver> deviceDrivers();
/// Null when no driver has that name.
const DeviceDriver* findDriver(const std::string& name);
/// All rows of all drivers.
std::vector<FoundDevice> findDevices();

/// The row of a driver whose device is always present.
std::vector<FoundDevice> alwaysThere(const DeviceDriver& self);
/// The row of a device that is found. `key` is the text behind the colon of its name, empty for the driver's name alone. `whyNot` is the
/// reason why it cannot be opened.
FoundDevice presentDevice(const DeviceDriver& self, const std::string& key, const haptics::DeviceInfo& info,
                          const std::string& whyNot = {});
FoundDevice absentDevice(const DeviceDriver& self, const std::string& whyNot, const std::string& key = {});
/// The rows, or one row with the reason why there is no device.
std::vector<FoundDevice> rowsOr(std::vector<FoundDevice> rows, const DeviceDriver& self, const std::string& whyNot);

}  // namespace reachlab::devices
