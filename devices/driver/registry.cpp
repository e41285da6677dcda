#include "devices/driver/registry.h"

#include <algorithm>

#include "devices/driver/drivers.h"

namespace reachlab::devices {

std::span<const DeviceDriver> deviceDrivers() {
  static const std::vector<DeviceDriver> drivers{
      simulatedDriver(),      partnerDriver(), replayDriver(),     mouseDriver(), virtualDriver(), phantomDriver(),
      forceDimensionDriver(), hidDriver(),     spaceMouseDriver(), haplyDriver(), polhemDriver(),  tabletDriver(),
  };
  return drivers;
}

const DeviceDriver* findDriver(const std::string& name) {
  const auto drivers = deviceDrivers();
  const auto at = std::find_if(drivers.begin(), drivers.end(), [&](const DeviceDriver& driver) { return driver.name == name; });
  return at == drivers.end() ? nullptr : &*at;
}

std::vector<FoundDevice> findDevices() {
  std::vector<FoundDevice> found;
  for (const DeviceDriver& driver : deviceDrivers())
    for (FoundDevice& device : driver.find(driver)) found.push_back(std::move(device));
  return found;
}

std::vector<FoundDevice> alwaysThere(const DeviceDriver& self) { return {presentDevice(self, {}, {})}; }

FoundDevice presentDevice(const DeviceDriver& self, const std::string& key, const haptics::DeviceInfo& info, const std::string& whyNot) {
  FoundDevice row = absentDevice(self, whyNot, key);
  if (!info.name.empty()) row.description = info.name;
  row.present = whyNot.empty();
  row.degreesOfFreedom = info.degreesOfFreedom;
  row.maxForce = info.rendersForce ? info.maxForce : 0;
  if (!info.rendersForce) row.continuousForce = 0;
  else if (info.maxContinuousForce > 0) row.continuousForce = info.maxContinuousForce;
  row.rate = info.rate;
  return row;
}

FoundDevice absentDevice(const DeviceDriver& self, const std::string& whyNot, const std::string& key) {
  FoundDevice row;
  row.name = self.name + (key.empty() ? "" : ":" + key);
  row.kind = self.name;
  row.description = self.description;
  row.whyNot = whyNot;
  return row;
}

std::vector<FoundDevice> rowsOr(std::vector<FoundDevice> rows, const DeviceDriver& self, const std::string& whyNot) {
  if (rows.empty()) rows.push_back(absentDevice(self, whyNot));
  return rows;
}

}  // namespace reachlab::devices
