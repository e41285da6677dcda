#pragma once
#include <string>
#include <string_view>

namespace reachlab::record {

/// The order of labels: whole numbers by value, before words by letter. "9" comes before "10", and "10" before "post".
bool labelBefore(std::string_view a, std::string_view b);

/// The order in which runs were recorded: by subject, session and run of their file names (`sub-01_ses-01_task-reach_run-01_log.reach`),
/// then by name. A name has the task before the run.
bool runBefore(const std::string& a, const std::string& b);

}  // namespace reachlab::record
