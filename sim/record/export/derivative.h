#pragma once
#include <string>

namespace reachlab::record {

/// What a folder of derivatives is, as BIDS asks (dataset_description.json); one that is there already is kept. `name`: "Tables of trials";
/// `software`: "reachlab 0.1.0"; `source`: the dataset, as it is named from the folder. Returns the file, empty when nothing was written.
/// Throws ResourceError.
std::string describeDerivative(const std::string& folder, const std::string& name, const std::string& software,
                               const std::string& source = "../..");

}  // namespace reachlab::record
