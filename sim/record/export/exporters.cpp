#include "sim/record/export/exporters.h"

#include <nlohmann/json.hpp>

#include "base/text_file.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/c3d_export.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/export/matlab_file.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::record {

const std::vector<Exporter>& exporters() {
  static const std::vector<Exporter> all{
      {"bids", "the dataset's motion, channels and events files", "", true, writeBids},
      {"csv", "trials.csv and samples", "derivatives/csv", false, writeTidyCsv},
      {"mat", "MATLAB, a file a run", "derivatives/mat", false, writeMatlab},
      {"hdf5", "HDF5, a file a run", "derivatives/hdf5", false, writeHdf5},
      {"c3d", "C3D, a file a trial", "derivatives/c3d", false, writeC3d},
  };
  return all;
}

std::vector<std::string> writeInto(const std::string& dataset, const Exporter& exporter, const std::vector<RunLog>& runs) {
  const std::string folder = exporter.folder.empty() ? dataset : dataset + "/" + std::string(exporter.folder);
  std::vector<std::string> written = exporter.write(runs, folder);
  if (exporter.folder.empty() || runs.empty()) return written;
  const std::string name = "Recorded runs as " + std::string(exporter.description);
  const std::string description = describeDerivative(folder, name, runs.back().configuration().softwareVersion);
  if (!description.empty()) written.push_back(description);
  return written;
}

const Exporter* findExporter(std::string_view name) {
  for (const Exporter& exporter : exporters())
    if (exporter.name == name) return &exporter;
  return nullptr;
}

std::string describeDerivative(const std::string& folder, const std::string& name, const std::string& software) {
  const std::string path = folder + "/dataset_description.json";
  if (isThere(path)) return {};
  const std::size_t space = software.find(' ');
  nlohmann::ordered_json j = nlohmann::ordered_json::object();
  j["Name"] = name;
  j["BIDSVersion"] = "1.9.0";
  j["DatasetType"] = "derivative";
  j["GeneratedBy"] = nlohmann::ordered_json::array({{{"Name", software.empty() ? "reachlab" : software.substr(0, space)},
                                                     {"Version", space == std::string::npos ? "n/a" : software.substr(space + 1)}}});
  j["SourceDatasets"] = nlohmann::ordered_json::array({{{"URL", "../.."}}});
  writeFileAtomically(path, j.dump(2) + "\n");
  return path;
}

}  // namespace reachlab::record
