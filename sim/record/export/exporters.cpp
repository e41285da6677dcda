#include "sim/record/export/exporters.h"

#include "sim/record/export/bids.h"
#include "sim/record/export/c3d_export.h"
#include "sim/record/export/derivative.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/export/matlab_file.h"
#include "sim/record/export/tidy_csv.h"

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

std::string folderIn(const std::string& dataset, const Exporter& exporter) {
  return exporter.folder.empty() ? dataset : dataset + "/" + std::string(exporter.folder);
}

std::vector<std::string> writeInto(const std::string& dataset, const Exporter& exporter, const std::vector<RunLog>& runs) {
  const std::string folder = folderIn(dataset, exporter);
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

}  // namespace reachlab::record
