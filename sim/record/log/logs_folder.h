#pragma once

namespace reachlab::record {

/// The folder in a dataset that holds its logs.
inline constexpr const char* kLogsFolder = "sourcedata";

}  // namespace reachlab::record
