#include "sim/session/programme.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/task_check.h"
#include "sim/trial/task_places.h"

namespace reachlab::session {

std::vector<Fault> warningsOf(const experiment::CompiledExperiment& scene, const dynamics::MethodChoice& choice) {
  std::vector<Fault> warnings = trial::implausibleNumbers(scene);
  for (Fault& fault : trial::describeWay(scene)) warnings.push_back(std::move(fault));
  for (const std::string& sentence : choice.warnings) warnings.push_back({{}, sentence});
  return warnings;
}

const experiment::CompiledExperiment& experimentOfStations(const Programme& programme) {
  if (programme.isPlan()) throw FaultError(Fault{"experiment", "is a plan", "a single experiment: the same one at every station"});
  return programme.experiments.front();
}

Programme programmeOf(const experiment::CompiledExperiment& experiment) {
  (void)dynamics::compileScene(experiment);
  Programme programme;
  programme.plan.blocks.emplace_back().experiment = experiment.experiment().name;
  programme.experiments.push_back(experiment);
  programme.scenes.push_back(scenesOf(programme.plan.blocks.front(), experiment));
  return programme;
}

namespace {

using What = std::pair<std::string, std::vector<experiment::Patch>>;  // many blocks do one experiment

experiment::CompiledExperiment openedFor(const PlanBlock& block) {
  experiment::CompiledExperiment experiment = openExperimentOf(block);
  trial::checkTask(experiment, block.experiment);
  return experiment;
}

// Throws FaultError for the first scene that cannot be computed. It is refused now, and not when the subject sits there.
void checkScenes(const std::vector<BlockScene>& scenes) {
  for (const BlockScene& scene : scenes) {
    try {
      (void)dynamics::compileScene(scene.experiment);
    } catch (const RefusedError& error) {
      throw FaultError(Fault{"experiment", fmt::format("cannot be computed in {}: {}", scene.condition, error.what())});
    }
  }
}

}  // namespace

Programme parseProgramme(const std::string& text, const std::string& file) {
  Programme programme{parsePlan(text, file), {}, {}};
  const JsonNode root = parseJson(text, file);
  std::vector<Fault> elsewhere, here;
  std::map<What, std::optional<experiment::CompiledExperiment>> opened;  // nullopt: the faults of this experiment are in the list already
  for (std::size_t i = 0; i < programme.plan.blocks.size(); ++i) {
    const PlanBlock& block = programme.plan.blocks[i];
    const auto [known, isNew] = opened.try_emplace(What{block.experiment, block.changes});
    try {
      if (isNew) known->second = openedFor(block);
    } catch (const FaultError& error) {
      for (const Fault& fault : error.faults) {  // those of the experiment's file stand there
        if (fault.place) elsewhere.push_back(fault);
        else here.push_back({fmt::format("blocks[{}].experiment", i), toText(fault)});
      }
    }
    if (!known->second) continue;
    programme.experiments.push_back(*known->second);
    try {
      programme.scenes.push_back(scenesOf(block, *known->second));
      if (isNew || !block.mix.isPlain()) checkScenes(programme.scenes.back());
    } catch (const FaultError& error) {
      for (Fault fault : error.faults) {
        fault.key = keyInPlan(root, i, fault.key);
        if (std::find(here.begin(), here.end(), fault) == here.end()) here.push_back(std::move(fault));
      }
    }
  }
  std::vector<Fault> found = atTheirPlaces(std::move(here), text, file);
  found.insert(found.end(), elsewhere.begin(), elsewhere.end());
  if (!found.empty()) throw FaultError(std::move(found));
  return programme;
}

Programme readProgramme(const std::string& fileOrName) {
  const std::optional<std::string> file = findPlan(fileOrName);
  const std::string text = file ? readTextFile(*file) : std::string();
  if (!file || !isPlan(text, *file)) return programmeOf(experiment::openExperiment(fileOrName));
  return parseProgramme(text, *file);
}

}  // namespace reachlab::session
