#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/fault.h"
#include "sim/experiment/describe.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/tidy_csv.h"

namespace reachlab::record {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTaskDescription = "Rest-to-rest reaching with the simulated object of experiment";
const std::string kObjectFollows = ". Object: ";

Json orNull(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// Empty where this program no longer understands what an earlier one recorded.
std::optional<experiment::Experiment> understood(const RunConfiguration& c) {
  try {
    return recordedValues(c);
  } catch (const FaultError&) {
    return std::nullopt;
  }
}

std::string taskDescription(const RunConfiguration& c, const std::optional<experiment::Experiment>& experiment) {
  return fmt::format("{} {}{}", kTaskDescription, c.experimentName, experiment ? kObjectFollows + experiment::describe(*experiment) : "");
}

}  // namespace

std::string experimentPath(const RunConfiguration& c) { return "code/experiments/" + runName(c) + "_experiment.json"; }

std::string describeTask(const RunConfiguration& c) { return taskDescription(c, understood(c)); }

std::string experimentNameIn(const std::string& description) {
  const std::size_t at = description.find(kTaskDescription);
  if (at == std::string::npos) return {};
  const std::string rest = description.substr(at + std::string(kTaskDescription).size() + 1);
  return rest.substr(0, rest.find(kObjectFollows));
}

std::string experimentJson(const RunConfiguration& c) {
  const std::optional<experiment::Experiment> experiment = understood(c);
  Json j = Json::object();
  j["description"] = taskDescription(c, experiment);
  const Json known = Json::parse(experiment ? experiment::toJson(*experiment) : c.experimentText, nullptr, false, true);
  j["experiment"] = known.is_discarded() ? Json() : known;
  j["definition"] = c.definitionText.empty() ? Json() : Json::parse(c.definitionText, nullptr, true, true);
  for (const RunScene& scene : c.scenes.value_or(std::vector<RunScene>())) {
    const Json text = Json::parse(scene.experimentText, nullptr, false, true);
    j["scenes"].push_back({{"kind", orNull(scene.kind)},
                           {"target", orNull(scene.target)},
                           {"condition", scene.condition},
                           {"method", orNull(scene.method)},
                           {"experiment", text.is_discarded() ? Json() : text}});
  }
  Json& run = j["run"] = Json::object();
  run["subject"] = c.subject, run["session"] = c.session, run["run"] = c.run, run["block"] = c.block, run["practice"] = c.practice;
  run["condition"] = orNull(c.condition);
  run["trials"] = c.trials.size(), run["pause_s"] = c.pauseSeconds, run["seed"] = c.sessionSeed;
  run["device"] = orNull(c.device), run["device_name"] = orNull(c.firstHand.name), run["device_version"] = orNull(c.firstHand.version);
  run["device_max_force_n"] = c.firstHand.maxForce, run["virtual_hand"] = c.firstHand.virtualHand;
  run["method"] = orNull(c.method), run["method_reason"] = orNull(c.methodReason);
  run["sampling_hz"] = c.samplingHz, run["clock"] = c.clock;
  run["software_version"] = orNull(c.softwareVersion), run["build"] = orNull(c.buildDescription);
  run["started_utc"] = orNull(c.startedUtc), run["notes"] = orNull(c.notes);
  return j.dump(2) + "\n";
}

namespace {

experiment::CompiledExperiment opened(const Json& experiment, const Json& file, const std::string& origin) {
  return experiment::openExperimentText(experiment.dump(2), origin, file.at("definition").is_null() ? "" : file.at("definition").dump(2));
}

}  // namespace

std::vector<experiment::CompiledExperiment> experimentsFromJson(const std::string& text, const std::string& origin,
                                                                const RunConfiguration& c) try {
  const Json j = Json::parse(text);
  std::vector<experiment::CompiledExperiment> experiments;
  if (!c.scenes) experiments.push_back(opened(j.at("experiment"), j, origin));
  for (const RunScene& scene : c.scenes.value_or(std::vector<RunScene>())) {
    const Json& all = j.at("scenes");
    const auto found = std::find_if(all.begin(), all.end(), [&](const Json& one) {
      return one.at("kind") == orNull(scene.kind) && one.at("target") == orNull(scene.target);
    });
    if (found == all.end())
      throw FaultError(fileFault(origin, fmt::format("has no scene for the condition {} of events.tsv", scene.condition)));
    Json experiment = found->at("experiment");
    experiment.emplace("name", c.experimentName);  // scenes are named as the run's experiment is, not as this file
    experiments.push_back(opened(experiment, j, origin));
  }
  return experiments;
} catch (const nlohmann::json::exception&) {
  throw FaultError(fileFault(origin, "is no experiment of a dataset", "what reach export writes into code/experiments"));
}

}  // namespace reachlab::record
