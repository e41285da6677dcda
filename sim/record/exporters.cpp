#include "sim/record/exporters.h"

#include "sim/record/bids.h"
#include "sim/record/tidy_csv.h"

namespace reachlab::record {

const std::vector<Exporter>& exporters() {
  static const std::vector<Exporter> all{
      {"bids", "the dataset's motion, channels and events files", "", true, writeBids},
      {"csv", "trials.csv and samples", "derivatives/csv", false, writeTidyCsv},
  };
  return all;
}

std::string folderIn(const std::string& dataset, const Exporter& exporter) {
  return exporter.folder.empty() ? dataset : dataset + "/" + std::string(exporter.folder);
}

const Exporter* findExporter(std::string_view name) {
  for (const Exporter& exporter : exporters())
    if (exporter.name == name) return &exporter;
  return nullptr;
}

}  // namespace reachlab::record
