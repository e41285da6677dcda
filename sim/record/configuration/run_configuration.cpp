#include "sim/record/configuration/run_configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/device.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/configuration/run_fields.h"

namespace reachlab::record {

using nlohmann::json;

namespace {

constexpr int kSchemaVersion = 1;  // of the configuration's keys: one whose meaning changes is another version

}  // namespace

std::vector<haptics::DeviceInfo> devicesOf(const RunConfiguration& c) {
  std::vector<haptics::DeviceInfo> devices{c.firstHand};
  devices.insert(devices.end(), c.otherHands.begin(), c.otherHands.end());
  return devices;
}

std::string toJson(const RunConfiguration& c) {
  json j = writeFields(c);
  j["schema_version"] = kSchemaVersion;
  return j.dump(1, ' ', false, json::error_handler_t::replace);
}

RunConfiguration configurationFromJson(std::string_view text, const std::string& origin) try {
  const json j = json::parse(text, nullptr, false);
  if (!j.is_object()) throw FaultError(Fault{.what = "is no JSON object"});
  if (const json& version = memberOf(j, "schema_version"); version != kSchemaVersion)
    throw FaultError(Fault{"schema_version", fmt::format("is {}", version.dump().substr(0, 40)),
                           fmt::format("{}; a newer reachlab reads newer recordings", kSchemaVersion)});
  RunConfiguration c;
  readFields(j, c);
  checkConfiguration(c);
  return c;
} catch (const FaultError& error) {
  throw FaultError(inFile(origin, inside("configuration", error.faults)));
}

namespace {

experiment::CompiledExperiment recordedText(const RunConfiguration& c, const std::string& text) {
  const auto written = experiment::openExperimentText(text, c.experimentName, c.definitionText);
  experiment::Experiment experiment = written.experiment();
  experiment.timing = c.timing;  // what held then, which the text may leave to a default
  if (experiment.task) experiment.task->rest = c.rest;
  return {experiment, written};
}

}  // namespace

experiment::Experiment recordedValues(const RunConfiguration& c) {
  return experiment::readUnchecked(c.experimentText, c.experimentName, c.definitionText);
}

experiment::Experiment recordedValues(const RunConfiguration& c, const trial::PlannedTrial& planned) {
  const RunScene* scene = sceneOf(c, planned);
  return scene != nullptr ? experiment::readUnchecked(scene->experimentText, c.experimentName, c.definitionText) : recordedValues(c);
}

experiment::CompiledExperiment recordedExperiment(const RunConfiguration& c) { return recordedText(c, c.experimentText); }

std::vector<experiment::CompiledExperiment> recordedScenes(const RunConfiguration& c) {
  if (!c.scenes) return {recordedExperiment(c)};
  std::vector<experiment::CompiledExperiment> scenes;
  for (const RunScene& scene : *c.scenes) scenes.push_back(recordedText(c, scene.experimentText));
  return scenes;
}

void checkConfiguration(const RunConfiguration& c) {
  std::vector<Fault> faults;
  for (const auto& [key, label] : {std::pair{"subject", c.subject}, std::pair{"session", c.session}, std::pair{"task", c.task}})
    if (const auto fault = labelFault(label, key)) faults.push_back(*fault);
  const std::size_t columns = rowWidth(c.table);
  const bool further =
      c.table.size() > columns && std::all_of(c.table.channels.begin() + static_cast<std::ptrdiff_t>(columns), c.table.channels.end(),
                                              [](const Channel& channel) { return channel.name.starts_with(kFurtherName); });
  if (c.table.size() != columns && !further)
    faults.push_back({"table", fmt::format("has {} channels", c.table.size()), fmt::format("{}, as its masses and hands have", columns)});
  if (static_cast<int>(c.otherHands.size()) + 1 != c.table.hands)
    faults.push_back(
        {"other_hands", fmt::format("has {} hands", c.otherHands.size()), fmt::format("{}, as the table has", c.table.hands - 1)});
  const std::size_t scenes = c.scenes ? c.scenes->size() : 1;
  if (scenes == 0) faults.push_back({"scenes", "is empty", "one scene or more"});
  for (const trial::PlannedTrial& planned : c.trials)
    if (static_cast<std::size_t>(planned.scene) >= scenes) {
      faults.push_back({"trials", fmt::format("has the scene {} among {} scenes", planned.scene, scenes), "a scene of the run"});
      break;
    }
  if (!faults.empty()) throw FaultError(std::move(faults));
}

std::optional<Fault> labelFault(const std::string& label, const std::string& key) {
  const bool good = !label.empty() && std::all_of(label.begin(), label.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
  if (good && label.size() <= kMaxLabelLength) return std::nullopt;
  return Fault{key, fmt::format("\"{}\" is not a label", label), fmt::format("up to {} letters and digits", kMaxLabelLength)};
}

std::vector<Fault> problems(const Participant& participant) {
  if (!participant.age || (*participant.age >= 0 && *participant.age <= kMaxAge)) return {};
  return {{"participant.age", fmt::format("is {}", *participant.age), fmt::format("0 to {:.0f} years", kMaxAge)}};
}

}  // namespace reachlab::record
