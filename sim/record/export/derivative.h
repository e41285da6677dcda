#pragma once
#include <string>

namespace reachlab::record {

/// Describes a folder of derivatives, as BIDS asks (dataset_description.json). A description that exists is kept. Examples: `name` "Tables
/// of trials", `software` "reachlab 0.1.0". `source` is the dataset, as it is named from the folder. Returns the file, empty when nothing
/// was written. Throws ResourceError.
std::string describeDerivative(const std::string& folder, const std::string& name, const std::string& software,
                               const std::string& source = "../..");

}  // namespace reachlab::record
