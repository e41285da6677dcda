#pragma once
#include <string>
#include <vector>

/// The mappings that a dataset keeps for each device and subject (docs/devices.md). The device is a value of `--device`, for one hand or
/// several. Each hand has its mapping, by kind and name of its device. Device and subject are checked elsewhere. For a faulty device or
/// subject no mapping is kept.
namespace reachlab::devices {

/// The device, with the kept mapping for each hand that asks for no mapping. The files are added to `taken`.
std::string withKeptMappings(const std::string& device, const std::string& data, const std::string& subject,
                             std::vector<std::string>& taken);

/// Keeps the mappings that the device text asks for. Returns their files, or an empty list without a mapping. Throws ResourceError.
std::vector<std::string> keepMappings(const std::string& device, const std::string& data, const std::string& subject);

}  // namespace reachlab::devices
