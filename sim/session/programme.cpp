#include "sim/session/programme.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/json/json_reader.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/task_check.h"

namespace reachlab::session {

Programme programmeOf(const experiment::CompiledExperiment& experiment) {
  Programme programme;
  programme.plan.blocks.emplace_back().experiment = experiment.experiment().name;
  programme.experiments.push_back(experiment);
  programme.scenes.push_back(scenesOf(programme.plan.blocks.front(), experiment));
  return programme;
}

namespace {

Programme programmeOfText(const std::string& text, const std::string& file) {
  Programme programme{parsePlan(text, file), {}, {}};
  using What = std::pair<std::string, std::vector<experiment::Patch>>;
  std::map<What, experiment::CompiledExperiment> opened;  // many blocks do one experiment
  for (const PlanBlock& block : programme.plan.blocks) {
    const What what{block.experiment, block.changes};
    auto known = opened.find(what);
    if (known == opened.end()) known = opened.emplace(what, openExperimentOf(block)).first;
    programme.experiments.push_back(known->second);
    programme.scenes.push_back(scenesOf(block, known->second));
  }
  return programme;
}

}  // namespace

Programme checkedProgramme(const std::string& file) {
  const std::string text = readTextFile(file);
  Programme programme{parsePlan(text, file), {}, {}};
  const JsonNode root = parseJson(text, file);
  std::vector<Fault> elsewhere, here;
  using What = std::pair<std::string, std::vector<experiment::Patch>>;
  std::map<What, std::optional<experiment::CompiledExperiment>> opened;  // nullopt: the faults of this experiment are in the list already
  for (std::size_t i = 0; i < programme.plan.blocks.size(); ++i) {
    const PlanBlock& block = programme.plan.blocks[i];
    const auto [known, isNew] = opened.try_emplace(What{block.experiment, block.changes});
    try {
      if (isNew) {
        const experiment::CompiledExperiment experiment = openExperimentOf(block);
        trial::checkTask(experiment, block.experiment);
        known->second = experiment;
      }
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

Programme programmeOf(const Plan& plan, const std::string& file) { return programmeOfText(toJson(plan), file); }

Programme readProgramme(const std::string& fileOrName) {
  const std::optional<std::string> file = findPlan(fileOrName);
  const std::string text = file ? readTextFile(*file) : std::string();
  if (!file || !isPlan(text, *file)) return programmeOf(experiment::openExperiment(fileOrName));
  return programmeOfText(text, *file);
}

}  // namespace reachlab::session
