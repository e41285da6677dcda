#include "sim/record/run_configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

json toJson(const Channel& c) {
  return {{"name", c.name},   {"component", c.component},     {"type", c.type},    {"tracked_point", c.trackedPoint},
          {"units", c.units}, {"description", c.description}, {"column", c.column}};
}

Channel channelFrom(const json& j) {
  return {j.at("name"), j.at("component"), j.at("type"), j.at("tracked_point"), j.at("units"), j.at("description"), j.at("column")};
}

json toJson(const Participant& p) {
  json j{{"sex", p.sex}, {"handedness", p.handedness}};
  if (p.age) j["age_years"] = *p.age;
  return j;
}

Participant participantFrom(const json& j) {
  Participant p;
  if (j.contains("age_years")) p.age = j.at("age_years").get<double>();
  p.sex = j.value("sex", "");
  p.handedness = j.value("handedness", "");
  return p;
}

json toJson(const std::vector<trial::PlannedTrial>& trials) {
  json list = json::array();
  for (const trial::PlannedTrial& t : trials)
    list.push_back({{"index", t.index}, {"foreperiod_ms", t.foreperiodTicks}, {"catch", t.catchTrial}});
  return list;
}

std::vector<trial::PlannedTrial> trialsFrom(const json& list) {
  std::vector<trial::PlannedTrial> trials;
  for (const json& j : list) trials.push_back({j.at("index"), j.at("foreperiod_ms"), j.at("catch")});
  return trials;
}

json tableToJson(const ChannelTable& table) {
  json channels = json::array();
  for (const Channel& channel : table.channels) channels.push_back(toJson(channel));
  return {{"mass_count", table.massCount}, {"parameter_count", table.parameterCount}, {"body", table.body}, {"channels", channels}};
}

ChannelTable tableFrom(const json& j) {
  ChannelTable table;
  table.massCount = j.at("mass_count");
  table.parameterCount = j.at("parameter_count");
  table.body = j.at("body");
  for (const json& channel : j.at("channels")) table.channels.push_back(channelFrom(channel));
  return table;
}

}  // namespace

std::string toJson(const RunConfiguration& c) {
  const json j{
      {"schema_version", 1},
      {"subject", c.subject},
      {"session", c.session},
      {"task", c.task},
      {"run", c.run},
      {"first_run", c.firstRun},
      {"first_trial", c.firstTrial},
      {"block", c.block},
      {"practice", c.practice},
      {"condition", c.condition},
      {"day", c.day},
      {"pause_s", c.pauseSeconds},
      {"repeat_aborted", c.repeatAborted},
      {"experiment_name", c.experimentName},
      {"experiment_text", c.experimentText},
      {"definition_text", c.definitionText},
      {"plan_name", c.planName},
      {"plan_text", c.planText},
      {"seed", c.seed},
      {"session_seed", c.sessionSeed},
      {"order_seed", c.orderSeed},
      {"trials", toJson(c.trials)},
      {"device", c.device},
      {"device_name", c.deviceName},
      {"device_version", c.deviceVersion},
      {"device_max_force_n", c.deviceMaxForce},
      {"virtual_hand", c.virtualHand},
      {"device_renders_force", c.rendersForce},
      {"device_continuous_force_n", c.deviceContinuousForce},
      {"device_thermal_s", c.deviceThermalSeconds},
      {"method", c.method},
      {"method_reason", c.methodReason},
      {"software_version", c.softwareVersion},
      {"build", c.buildDescription},
      {"computer", c.computer},
      {"started_utc", c.startedUtc},
      {"clock", c.clock},
      {"sampling_hz", c.samplingHz},
      {"sample_every_ticks", c.sampleEveryTicks},
      {"participant", toJson(c.participant)},
      {"notes", c.notes},
      {"table", tableToJson(c.table)},
  };
  return j.dump(1, ' ', false, json::error_handler_t::replace);
}

RunConfiguration configurationFromJson(std::string_view text, const std::string& origin) {
  try {
    const json j = json::parse(text);
    RunConfiguration c;
    c.subject = j.at("subject");
    c.session = j.at("session");
    c.task = j.at("task");
    c.run = j.at("run");
    c.firstRun = j.at("first_run");
    c.firstTrial = j.at("first_trial");
    c.block = j.at("block");
    c.practice = j.at("practice");
    c.condition = j.at("condition");
    c.day = j.at("day");
    c.pauseSeconds = j.at("pause_s");
    c.repeatAborted = j.at("repeat_aborted");
    c.experimentName = j.at("experiment_name");
    c.experimentText = j.at("experiment_text");
    c.definitionText = j.value("definition_text", "");  // logs before 2026-11-21 have none
    c.planName = j.at("plan_name");
    c.planText = j.at("plan_text");
    c.seed = j.at("seed");
    c.sessionSeed = j.at("session_seed");
    c.orderSeed = j.at("order_seed");
    c.trials = trialsFrom(j.at("trials"));
    c.device = j.at("device");
    c.deviceName = j.at("device_name");
    c.deviceVersion = j.at("device_version");
    c.deviceMaxForce = j.at("device_max_force_n");
    c.virtualHand = j.at("virtual_hand");
    c.rendersForce = j.value("device_renders_force", false);
    c.deviceContinuousForce = j.value("device_continuous_force_n", 0.0);
    c.deviceThermalSeconds = j.value("device_thermal_s", 10.0);
    c.method = j.at("method");
    c.methodReason = j.at("method_reason");
    c.softwareVersion = j.at("software_version");
    c.buildDescription = j.at("build");
    c.computer = j.at("computer");
    c.startedUtc = j.at("started_utc");
    c.clock = j.at("clock");
    c.samplingHz = j.at("sampling_hz");
    c.sampleEveryTicks = j.at("sample_every_ticks");
    c.participant = participantFrom(j.at("participant"));
    c.notes = j.at("notes");
    c.table = tableFrom(j.at("table"));
    return c;
  } catch (const json::exception& fault) {
    throw UsageError(fmt::format("{}: configuration record cannot be understood: {}", origin, fault.what()));
  }
}

experiment::Experiment recordedExperiment(const RunConfiguration& c) {
  return experiment::parseExperiment(c.experimentText, c.experimentName, c.definitionText);
}

void checkLabel(const std::string& label, const std::string& what) {
  const bool good = !label.empty() && std::all_of(label.begin(), label.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
  if (!good) throw UsageError(fmt::format("{} \"{}\": not a label; allowed: letters and digits only", what, label));
}

void checkParticipant(const Participant& participant) {
  if (participant.age && !(*participant.age >= 0 && *participant.age <= 130))
    throw UsageError(fmt::format("--age {}: allowed: 0 to 130 years", *participant.age));
}

}  // namespace reachlab::record
