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

/// What a driver is given to make a device: NAME:ARGUMENT, and the run it is for.
struct DeviceRequest {
  std::string name, argument;  // argument: behind the colon, empty without one
  const experiment::CompiledExperiment& experiment;
  std::uint64_t seed = 0;
  /// For messages: "device phantom:Left".
  std::string words() const { return "device " + name + (argument.empty() ? "" : ":" + argument); }
};

/// One row of `reach list devices`: a device that is there, under the name that opens it, or a kind of which none is, once.
struct FoundDevice {
  std::string name;
  std::string kind;  // the driver's name
  std::string description;
  bool present = false;
  std::string whyNot;  // in the loader's, the system's or the device's own words, with what to do; empty when present
  std::optional<int> degreesOfFreedom;
  std::optional<double> maxForce, continuousForce;  // [N]; 0: it renders none
  std::optional<double> rate;                       // [1/s]
};

/// One kind of device. A new driver is a file that makes one of these and a line in registry.cpp; `reach list devices`, help texts and
/// the window read it from there.
struct DeviceDriver {
  std::string name;         // "phantom"
  std::string usage;        // "phantom[:NAME]"
  std::string description;  // one line
  bool inWindowOnly = false;
  /// What of this kind is there, or one row that says why nothing is. Opens no more than it must, and leaves all as it was.
  std::vector<FoundDevice> (*find)(const DeviceDriver& self);
  /// Throws FaultError (a wrong argument), ResourceError (it cannot be had).
  std::unique_ptr<haptics::HapticDevice> (*make)(const DeviceRequest& request);
  bool isMade = false;  // by this program: there are as many as are asked for
};

/// Every driver of this program, in the order of lists.
std::span<const DeviceDriver> deviceDrivers();
/// Null when there is none of that name.
const DeviceDriver* findDriver(const std::string& name);
/// All rows of all drivers.
std::vector<FoundDevice> findDevices();

/// Where the hand of this experiment is to begin [m], world frame; the origin without a task.
Vec3 startOf(const experiment::CompiledExperiment& experiment);
/// For drivers whose device is always there.
std::vector<FoundDevice> alwaysThere(const DeviceDriver& self);
/// A row of `self` that fills in what `info` says.
FoundDevice presentDevice(const DeviceDriver& self, const std::string& name, const haptics::DeviceInfo& info);
FoundDevice absentDevice(const DeviceDriver& self, const std::string& whyNot);

}  // namespace reachlab::devices
