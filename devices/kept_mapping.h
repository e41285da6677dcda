#pragma once
#include <string>
#include <vector>

/// Mappings that a dataset keeps for each device and subject (docs/devices.md). A device is what `--device` takes, of one hand or of several:
/// each hand has its own, by kind and name. Device and subject are checked elsewhere: of a faulty one nothing is kept.
namespace reachlab::devices {

/// The device with what is kept for it where no mapping was asked for; the files are added to `taken`.
std::string withKeptMappings(const std::string& device, const std::string& data, const std::string& subject,
                             std::vector<std::string>& taken);

/// Keeps the mappings that the device is asked for with; their files, none without a mapping. Throws ResourceError.
std::vector<std::string> keepMappings(const std::string& device, const std::string& data, const std::string& subject);

}  // namespace reachlab::devices
