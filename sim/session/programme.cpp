#include "sim/session/programme.h"

#include <map>

#include "base/json/json_tree.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"

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

Programme programmeOf(const Plan& plan, const std::string& file) { return programmeOfText(toJson(plan), file); }

Programme readProgramme(const std::string& fileOrName) {
  const std::optional<std::string> file = findPlan(fileOrName);
  const std::string text = file ? readTextFile(*file) : std::string();
  if (!file || !isPlan(text, *file)) return programmeOf(experiment::openExperiment(fileOrName));
  return programmeOfText(text, *file);
}

}  // namespace reachlab::session
