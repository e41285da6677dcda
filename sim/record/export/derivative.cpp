#include "sim/record/export/derivative.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/record/log/atomic_file.h"

namespace reachlab::record {

std::string describeDerivative(const std::string& folder, const std::string& name, const std::string& software, const std::string& source) {
  const std::string path = folder + "/dataset_description.json";
  std::error_code error;
  if (std::filesystem::exists(path, error)) return {};
  const std::size_t space = software.find(' ');
  nlohmann::ordered_json j = nlohmann::ordered_json::object();
  j["Name"] = name;
  j["BIDSVersion"] = "1.9.0";
  j["DatasetType"] = "derivative";
  j["GeneratedBy"] = nlohmann::ordered_json::array({{{"Name", software.empty() ? "reachlab" : software.substr(0, space)},
                                                     {"Version", space == std::string::npos ? "n/a" : software.substr(space + 1)}}});
  j["SourceDatasets"] = nlohmann::ordered_json::array({{{"URL", source}}});
  writeFileAtomically(path, j.dump(2) + "\n");
  return path;
}

}  // namespace reachlab::record
