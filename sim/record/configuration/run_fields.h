#pragma once
#include <limits>

#include "base/maybe_const.h"
#include "base/ticks.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/record/configuration/json_fields.h"
#include "sim/record/configuration/limits.h"
#include "sim/record/configuration/run_configuration.h"

/// The fields of a run's configuration in JSON: the only list for reading, writing and comparing. A new field is one member in
/// run_configuration.h and one line here. The member is a std::optional, since recordings of 0.2.0 do not have it.
namespace reachlab::record {

inline constexpr double kMaxTrials = 1e7, kMaxForeperiod = 1e9, kMaxChannels = 1e4, kMaxNewtons = 1e6, kMaxScenes = 1e5;
inline constexpr double kAny = std::numeric_limits<double>::max();  // a request has no bound

template <MaybeConst<Channel> T, class Visit>
void visitFields(T& c, const Visit& visit) {
  visit(Field{"name"}, c.name);
  visit(Field{"component"}, c.component);
  visit(Field{"type"}, c.type);
  visit(Field{"tracked_point"}, c.trackedPoint);
  visit(Field{"units"}, c.units);
  visit(Field{"description"}, c.description);
  visit(Field{"column"}, c.column);
}

template <MaybeConst<ChannelTable> T, class Visit>
void visitFields(T& t, const Visit& visit) {
  visit(Field{"mass_count", 0, experiment::kMaxMasses}, t.massCount);
  visit(Field{"parameter_count", 0, 3}, t.parameterCount);
  visit(Field{"body"}, t.body);
  visit(Field{"port_energy"}, t.portEnergy);
  visit(Field{"hands", 1, experiment::kMaxHands}, t.hands);
  visit(Field{"environment"}, t.environment);
  visit(Field{"cursor"}, t.cursor);
  visit(Field{.key = "channels", .most = kMaxChannels}, t.channels);
}

template <MaybeConst<trial::PlannedTrial> T, class Visit>
void visitFields(T& t, const Visit& visit) {
  visit(Field{"index", 0, kMaxTrials}, t.index);
  visit(Field{"foreperiod_ms", 0, kMaxForeperiod}, t.foreperiodTicks);
  visit(Field{"catch"}, t.catchTrial);
  visit(Field{.key = "scene", .most = kMaxScenes, .zeroIfMissing = true}, t.scene);
}

template <MaybeConst<Participant> T, class Visit>
void visitFields(T& p, const Visit& visit) {
  visit(Field{"age_years", 0, kMaxAge}, p.age);
  visit(Field{"sex"}, p.sex);
  visit(Field{"handedness"}, p.handedness);
}

template <MaybeConst<experiment::TimingLimits> T, class Visit>
void visitFields(T& t, const Visit& visit) {
  visit(Field{"max_missed_ticks", 0, experiment::kNoTimingLimits.maxMissedTicks}, t.maxMissedTicks);
  visit(Field{"max_gap_s", kTickSeconds, experiment::kNoTimingLimits.maxGap}, t.maxGap);
}

template <MaybeConst<experiment::StartRest> T, class Visit>
void visitFields(T& r, const Visit& visit) {
  visit(Field{"rest_s", 0, experiment::kMaxRestDuration}, r.seconds);
  visit(Field{"rest_speed_m_per_s", 0, kAny}, r.speed);
}

template <MaybeConst<haptics::GuardSettings> T, class Visit>
void visitFields(T& g, const Visit& visit) {
  visit(Field{"wall_centre_m"}, g.wallCentre);
  visit(Field{"wall_radius_m", 0, 1e3}, g.wallRadius);
  visit(Field{"wall_stiffness_n_per_m", 0, 1e6}, g.wallStiffness);
  visit(Field{"wall_damping_n_s_per_m", 0, 1e6}, g.wallDamping);
  visit(Field{"compensation_n"}, g.compensation);
  visit(Field{"passivity_control"}, g.passivityControl);
}

/// The facts about a device that are recorded: of a further hand. Those of the first hand have other keys, see below.
template <MaybeConst<haptics::DeviceInfo> T, class Visit>
void visitFields(T& h, const Visit& visit) {
  visit(Field{"name"}, h.name);
  visit(Field{"version"}, h.version);
  visit(Field{"max_force_n", 0, kMaxNewtons}, h.maxForce);
  visit(Field{"virtual_hand"}, h.virtualHand);
  visit(Field{"renders_force"}, h.rendersForce);
  visit(Field{"continuous_force_n", 0, kMaxNewtons}, h.maxContinuousForce);
  visit(Field{"thermal_s", 1e-3, 1e6}, h.thermalSeconds);
  visit(Field{"guards"}, h.guards);
  visit(Field{"mapping"}, h.mapping);
}

template <MaybeConst<RunScene> T, class Visit>
void visitFields(T& s, const Visit& visit) {
  visit(Field{"kind"}, s.kind);
  visit(Field{"target"}, s.target);
  visit(Field{"condition"}, s.condition);
  visit(Field{"experiment_text"}, s.experimentText);
  visit(Field{"method"}, s.method);
  visit(Field{"method_reason"}, s.methodReason);
}

template <MaybeConst<RunConfiguration> T, class Visit>
void visitFields(T& c, const Visit& visit) {
  visit(Field{"subject"}, c.subject);
  visit(Field{"session"}, c.session);
  visit(Field{"task"}, c.task);
  visit(Field{"run", 1, kMaxRun}, c.run);
  visit(Field{"first_run", 1, kMaxRun}, c.firstRun);
  visit(Field{"first_trial", 1, kMaxTrials}, c.firstTrial);
  visit(Field{"block", 1, kMaxTrials}, c.block);
  visit(Field{"practice"}, c.practice);
  visit(Field{"condition"}, c.condition);
  visit(Field{"day", 0, kMaxTrials}, c.day);
  visit(Field{"pause_s", 0, kAny}, c.pauseSeconds);
  visit(Field{"repeat_aborted"}, c.repeatAborted);
  visit(Field{"experiment_name"}, c.experimentName);
  visit(Field{"experiment_text"}, c.experimentText);
  visit(Field{"definition_text"}, c.definitionText);
  visit(Field{"plan_name"}, c.planName);
  visit(Field{"plan_text"}, c.planText);
  visit(Field{"seed"}, c.seed);
  visit(Field{"session_seed"}, c.sessionSeed);
  visit(Field{"order_seed"}, c.orderSeed);
  visit(Field{.key = "trials", .most = kMaxTrials}, c.trials);
  visit(Field{.key = "scenes", .most = kMaxScenes}, c.scenes);
  visit(Field{"device"}, c.device);
  visit(Field{"device_name"}, c.firstHand.name);
  visit(Field{"device_version"}, c.firstHand.version);
  visit(Field{"device_max_force_n", 0, kMaxNewtons}, c.firstHand.maxForce);
  visit(Field{"virtual_hand"}, c.firstHand.virtualHand);
  visit(Field{"device_renders_force"}, c.firstHand.rendersForce);
  visit(Field{"device_continuous_force_n", 0, kMaxNewtons}, c.firstHand.maxContinuousForce);
  visit(Field{"device_thermal_s", 1e-3, 1e6}, c.firstHand.thermalSeconds);
  visit(Field{"instruments"}, c.instruments);
  visit(Field{"method"}, c.method);
  visit(Field{"method_reason"}, c.methodReason);
  visit(Field{"software_version"}, c.softwareVersion);
  visit(Field{"build"}, c.buildDescription);
  visit(Field{"computer"}, c.computer);
  visit(Field{"started_utc"}, c.startedUtc);
  visit(Field{"clock"}, c.clock);
  visit(Field{"sampling_hz", 1e-3, 1e6}, c.samplingHz);
  visit(Field{"sample_every_ticks", 1, 1e6}, c.sampleEveryTicks);
  visit(Field{"timing"}, c.timing);
  visit(Field{"start_rest"}, c.rest);
  visit(Field{"guards"}, c.firstHand.guards);
  visit(Field{"device_mapping"}, c.firstHand.mapping);
  visit(Field{"participant"}, c.participant);
  visit(Field{"notes"}, c.notes);
  visit(Field{.key = "other_hands", .most = experiment::kMaxHands}, c.otherHands);
  visit(Field{"table"}, c.table);
}

}  // namespace reachlab::record
