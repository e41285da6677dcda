#pragma once
#include <string>
#include <string_view>

/// Labels in the names of a run's files, such as `sub-01_ses-01_task-reach_run-01_log.reach`, and their order.
namespace reachlab::record {

/// The label behind a key in a file's name, without its folder: "01" of "run". Empty if the name has no such key.
std::string labelIn(const std::string& name, const std::string& key);

/// The order of labels: whole numbers by value, before words by letter. "9" comes before "10", and "10" before "post".
bool labelBefore(std::string_view a, std::string_view b);

/// The order in which runs were recorded: by subject, session and run of their file names, then by name. A name has the task before the run.
bool runBefore(const std::string& a, const std::string& b);

}  // namespace reachlab::record
