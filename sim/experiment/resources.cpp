
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::experiment {
namespace fs = std::filesystem;

std::string resourceFolder() {
  std::vector<fs::path> places;
  if (const char* chosen = std::getenv("REACHLAB_RESOURCES")) places.emplace_back(chosen);
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (!program.empty()) places.push_back(program.parent_path().parent_path() / "share" / "reachlab");
  places.emplace_back(REACHLAB_RESOURCES_IN_SOURCE);
  places.emplace_back(REACHLAB_RESOURCES_INSTALLED);
  for (const fs::path& place : places)
    if (isFolder(place / "experiments")) return place.string();
  throw ResourceError("the resources (shipped experiments) are not found; set REACHLAB_RESOURCES to their folder");
}

namespace {

constexpr const char* kTwoHands = "two-hands";

}  // namespace

std::vector<std::string> shippedNames(const std::string& kind) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(resourceFolder()) / kind, ignored))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> shippedExperiments() { return shippedNames("experiments"); }

std::vector<std::string> shippedForTwoHands() { return shippedNames(std::string("experiments/") + kTwoHands); }

std::optional<std::string> shippedExperimentFile(const std::string& name) {
  const fs::path folder = fs::path(resourceFolder()) / "experiments";
  const auto has = [&](const std::vector<std::string>& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (has(shippedExperiments())) return (folder / (name + ".json")).string();
  if (has(shippedForTwoHands())) return (folder / kTwoHands / (name + ".json")).string();
  return std::nullopt;
}

CompiledExperiment openExperiment(const std::string& fileOrName) {
  if (isFile(fileOrName)) return openExperimentText(readTextFile(fileOrName), fileOrName);
  const bool looksLikeFile = fileOrName.find('/') != std::string::npos || fs::path(fileOrName).has_extension();
  const std::vector<std::string> names = shippedExperiments();
  if (const auto file = shippedExperimentFile(fileOrName)) return openExperimentText(readTextFile(*file), *file);
  if (isFolder(fileOrName)) throw FaultError(Fault{fileOrName, "is a folder", "an experiment file or name"});
  requireSearchable(fileOrName);
  if (looksLikeFile) throw FaultError(Fault{fileOrName, "there is no such file", "an experiment file, or one of " + listOf(names)});
  if (const std::vector<std::string> plans = shippedNames("plans"); std::find(plans.begin(), plans.end(), fileOrName) != plans.end()) {
    const std::string file = (fs::path(resourceFolder()) / "plans" / (fileOrName + ".json")).string();
    return openExperimentText(readTextFile(file), file);  // which refuses a plan
  }
  std::vector<std::string> all = names;
  for (const std::vector<std::string>& more : {shippedForTwoHands(), shippedNames("plans")})
    all.insert(all.end(), more.begin(), more.end());
  throw FaultError(
      Fault{fileOrName, "is neither a file nor a shipped experiment" + didYouMean(fileOrName, all), "a file, or one of " + listOf(names)});
}

Experiment readExperiment(const std::string& fileOrName) { return openExperiment(fileOrName).experiment(); }

}  // namespace reachlab::experiment
