#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A way to write recorded runs for other programs. A new format is a file with its `write`, and its line in exporters.cpp. The help of the
/// command line, its choices, and the end of every recorded run follow from the list.
struct Exporter {
  std::string_view name;         // as asked for: "bids"
  std::string_view description;  // a few words for lists and help
  std::string_view folder;       // where in the dataset, unless another is asked for; empty: the dataset itself
  bool withEachRun = false;      // written at the end of every recorded run, so that the dataset is up to date
  /// Adds these runs to the folder and returns the files written. Throws ResourceError. Other programs may not write at once.
  std::vector<std::string> (*write)(const std::vector<RunLog>& runs, const std::string& folder) = nullptr;
};

const std::vector<Exporter>& exporters();
/// Writes these runs into its folder of the dataset. A folder of derivatives then also has its description. Throws ResourceError.
std::vector<std::string> writeInto(const std::string& dataset, const Exporter& exporter, const std::vector<RunLog>& runs);
/// Null for an unknown name.
const Exporter* findExporter(std::string_view name);

/// Describes a folder in a dataset's `derivatives`, as BIDS asks (dataset_description.json). A description that exists is kept. Examples:
/// `name` "Tables of trials", `software` "reachlab 0.1.0". Returns the file, empty when nothing was written. Throws ResourceError.
std::string describeDerivative(const std::string& folder, const std::string& name, const std::string& software);

}  // namespace reachlab::record
