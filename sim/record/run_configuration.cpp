#include "sim/record/run_configuration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "sim/experiment/checked_experiment.h"
#include "sim/record/checked_json.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

constexpr int kMostRuns = 9999, kMostTrials = 10'000'000, kMostForeperiod = 1'000'000'000, kMostChannels = 10'000;

json toJson(const Channel& c) {
  return {{"name", c.name},   {"component", c.component},     {"type", c.type},    {"tracked_point", c.trackedPoint},
          {"units", c.units}, {"description", c.description}, {"column", c.column}};
}

Channel channelFrom(const json& j) {
  return {textOf(j, "name"),  textOf(j, "component"),   textOf(j, "type"),  textOf(j, "tracked_point"),
          textOf(j, "units"), textOf(j, "description"), textOf(j, "column")};
}

json toJson(const Participant& p) {
  json j{{"sex", p.sex}, {"handedness", p.handedness}};
  if (p.age) j["age_years"] = *p.age;
  return j;
}

Participant participantFrom(const json& j) {
  if (!j.is_object()) throw UsageError("participant: is no object");
  Participant p;
  if (j.contains("age_years")) p.age = numberOf(j, "age_years", 0, 130);
  if (j.contains("sex")) p.sex = textOf(j, "sex");
  if (j.contains("handedness")) p.handedness = textOf(j, "handedness");
  return p;
}

experiment::TimingLimits timingFrom(const json& j) {
  if (!j.is_object()) throw UsageError("timing: is no object");
  return {static_cast<int>(wholeOf(j, "max_missed_ticks", 0, experiment::kNoTimingLimits.maxMissedTicks)),
          numberOf(j, "max_gap_s", 0.001, experiment::kNoTimingLimits.maxGap)};
}

experiment::StartRest restFrom(const json& j) {
  if (!j.is_object()) throw UsageError("start_rest: is no object");
  return {numberOf(j, "rest_s", 0, 60), numberOf(j, "rest_speed_m_per_s", 0, 1e6)};
}

json toJson(const std::vector<trial::PlannedTrial>& trials) {
  json list = json::array();
  for (const trial::PlannedTrial& t : trials)
    list.push_back({{"index", t.index}, {"foreperiod_ms", t.foreperiodTicks}, {"catch", t.catchTrial}});
  return list;
}

std::vector<trial::PlannedTrial> trialsFrom(const json& list) {
  std::vector<trial::PlannedTrial> trials;
  for (const json& j : list)
    trials.push_back({static_cast<int>(wholeOf(j, "index", 0, kMostTrials)),
                      static_cast<int>(wholeOf(j, "foreperiod_ms", 0, kMostForeperiod)), flagOf(j, "catch")});
  return trials;
}

json toJson(const Vec3& v) { return json::array({v.x, v.y, v.z}); }

Vec3 vectorFrom(const json& j, const char* name) {
  const json& list = listOf(j, name, 3);
  const bool good = list.size() == 3 && std::all_of(list.begin(), list.end(), [](const json& x) { return x.is_number(); });
  if (!good) throw UsageError(fmt::format("{}: is not three numbers", name));
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

json guardsToJson(const haptics::GuardSettings& g) {
  return {{"wall_centre_m", toJson(g.wallCentre)},     {"wall_radius_m", g.wallRadius},
          {"wall_stiffness_n_per_m", g.wallStiffness}, {"wall_damping_n_s_per_m", g.wallDamping},
          {"compensation_n", toJson(g.compensation)},  {"passivity_control", g.passivityControl}};
}

haptics::GuardSettings guardsFrom(const json& j) {
  haptics::GuardSettings g;
  g.wallCentre = vectorFrom(j, "wall_centre_m");
  g.wallRadius = numberOf(j, "wall_radius_m", 0, 1e3);
  g.wallStiffness = numberOf(j, "wall_stiffness_n_per_m", 0, 1e6);
  g.wallDamping = numberOf(j, "wall_damping_n_s_per_m", 0, 1e6);
  g.compensation = vectorFrom(j, "compensation_n");
  g.passivityControl = flagOf(j, "passivity_control");
  return g;
}

json tableToJson(const ChannelTable& table) {
  json channels = json::array();
  for (const Channel& channel : table.channels) channels.push_back(toJson(channel));
  return {{"mass_count", table.massCount},
          {"parameter_count", table.parameterCount},
          {"body", table.body},
          {"port_energy", table.portEnergy},
          {"channels", channels}};
}

ChannelTable tableFrom(const json& j) {
  ChannelTable table;
  table.massCount = static_cast<int>(wholeOf(j, "mass_count", 1, experiment::kMaxMasses));
  table.parameterCount = static_cast<int>(wholeOf(j, "parameter_count", 0, 3));
  table.body = flagOf(j, "body");
  table.portEnergy = j.contains("port_energy") && flagOf(j, "port_energy");
  for (const json& channel : listOf(j, "channels", kMostChannels)) table.channels.push_back(channelFrom(channel));
  return table;
}

}  // namespace

std::string toJson(const RunConfiguration& c) {
  json j{
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
      {"start_rest", {{"rest_s", c.rest.seconds}, {"rest_speed_m_per_s", c.rest.speed}}},
      {"timing", {{"max_missed_ticks", c.timing.maxMissedTicks}, {"max_gap_s", c.timing.maxGap}}},
      {"guards", guardsToJson(c.guards)},
      {"device_mapping", c.deviceMapping},
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
    const json j = json::parse(text, nullptr, false);
    if (!j.is_object()) throw UsageError("is no JSON object");
    RunConfiguration c;
    c.subject = textOf(j, "subject");
    c.session = textOf(j, "session");
    c.task = textOf(j, "task");
    c.run = static_cast<int>(wholeOf(j, "run", 1, kMostRuns));
    c.firstRun = static_cast<int>(wholeOf(j, "first_run", 1, kMostRuns));
    c.firstTrial = static_cast<int>(wholeOf(j, "first_trial", 1, kMostTrials));
    c.block = static_cast<int>(wholeOf(j, "block", 1, kMostTrials));
    c.practice = flagOf(j, "practice");
    c.condition = textOf(j, "condition");
    c.day = static_cast<int>(wholeOf(j, "day", 0, kMostTrials));
    c.pauseSeconds = numberOf(j, "pause_s", 0, 1e6);
    c.repeatAborted = flagOf(j, "repeat_aborted");
    c.experimentName = textOf(j, "experiment_name");
    c.experimentText = textOf(j, "experiment_text");
    if (j.contains("definition_text")) c.definitionText = textOf(j, "definition_text");  // logs before 2026-11-21 have none
    c.planName = textOf(j, "plan_name");
    c.planText = textOf(j, "plan_text");
    c.seed = seedOf(j, "seed");
    c.sessionSeed = seedOf(j, "session_seed");
    c.orderSeed = seedOf(j, "order_seed");
    c.trials = trialsFrom(listOf(j, "trials", kMostTrials));
    c.device = textOf(j, "device");
    c.deviceName = textOf(j, "device_name");
    c.deviceVersion = textOf(j, "device_version");
    c.deviceMaxForce = numberOf(j, "device_max_force_n", 0, 1e6);
    c.virtualHand = flagOf(j, "virtual_hand");
    if (j.contains("device_renders_force")) c.rendersForce = flagOf(j, "device_renders_force");
    c.deviceContinuousForce = j.contains("device_continuous_force_n") ? numberOf(j, "device_continuous_force_n", 0, 1e6) : 0;
    c.deviceThermalSeconds = j.contains("device_thermal_s") ? numberOf(j, "device_thermal_s", 1e-3, 1e6) : 10;
    if (j.contains("start_rest")) c.rest = restFrom(memberOf(j, "start_rest"));
    if (j.contains("timing")) c.timing = timingFrom(memberOf(j, "timing"));
    if (j.contains("guards")) c.guards = guardsFrom(memberOf(j, "guards"));
    if (j.contains("device_mapping")) c.deviceMapping = textOf(j, "device_mapping");
    c.method = textOf(j, "method");
    c.methodReason = textOf(j, "method_reason");
    c.softwareVersion = textOf(j, "software_version");
    c.buildDescription = textOf(j, "build");
    c.computer = textOf(j, "computer");
    c.startedUtc = textOf(j, "started_utc");
    c.clock = textOf(j, "clock");
    c.samplingHz = numberOf(j, "sampling_hz", 1e-3, 1e6);
    c.sampleEveryTicks = static_cast<std::uint32_t>(wholeOf(j, "sample_every_ticks", 1, 1'000'000));
    c.participant = participantFrom(memberOf(j, "participant"));
    c.notes = textOf(j, "notes");
    c.table = tableFrom(memberOf(j, "table"));
    checkConfiguration(c);
    return c;
  } catch (const UsageError& fault) {
    throw UsageError(fmt::format("{}: configuration record cannot be understood: {}", origin, fault.what()));
  }
}

experiment::Experiment recordedValues(const RunConfiguration& c) {
  return experiment::readUnchecked(c.experimentText, c.experimentName, c.definitionText);
}

experiment::Experiment recordedExperiment(const RunConfiguration& c) {
  experiment::Experiment experiment = experiment::parseExperiment(c.experimentText, c.experimentName, c.definitionText);
  experiment.timing = c.timing;  // what held then, which the text may leave to a default
  if (experiment.task) experiment.task->rest = c.rest;
  return experiment;
}

void checkConfiguration(const RunConfiguration& c) {
  std::vector<Fault> faults;
  for (const auto& [key, label] : {std::pair{"subject", c.subject}, std::pair{"session", c.session}, std::pair{"task", c.task}})
    if (const auto fault = labelFault(label, key)) faults.push_back(*fault);
  const std::size_t columns = rowWidth(c.table.massCount, c.table.parameterCount, c.table.body, c.table.portEnergy);
  if (c.table.size() != columns)
    faults.push_back({"table", fmt::format("has {} channels", c.table.size()), fmt::format("{}, as its masses have", columns)});
  if (!faults.empty()) throw FaultError(std::move(faults));
}

std::optional<Fault> labelFault(const std::string& label, const std::string& key) {
  constexpr std::size_t kLongestLabel = 60;  // file names join three of them and may have 255 bytes
  const bool good = !label.empty() && std::all_of(label.begin(), label.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
  if (good && label.size() <= kLongestLabel) return std::nullopt;
  return Fault{key, fmt::format("\"{}\" is not a label", label), fmt::format("up to {} letters and digits", kLongestLabel)};
}

std::vector<Fault> problems(const Participant& participant) {
  if (!participant.age || (*participant.age >= 0 && *participant.age <= 130)) return {};
  return {{"participant.age", fmt::format("is {}", *participant.age), "0 to 130 years"}};
}

}  // namespace reachlab::record
