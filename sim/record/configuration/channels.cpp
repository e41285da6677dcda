#include "sim/record/configuration/channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/fault.h"
#include "base/ticks.h"
#include "sim/experiment/experiment.h"

namespace reachlab::record {
namespace {

constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

struct Quantity {
  std::string name, column;  // before "_x" / with {} for the axis
  std::string type, trackedPoint, units, description;
};

void addVector(std::vector<Channel>& out, const Quantity& q) {
  for (const char* axis : kAxes)
    out.push_back({q.name + "_" + axis, axis, q.type, q.trackedPoint, q.units, q.description, fmt::format(fmt::runtime(q.column), axis)});
}

void addScalar(std::vector<Channel>& out, const Quantity& q) {
  out.push_back({q.name, "n/a", q.type, q.trackedPoint, q.units, q.description, q.column});
}

void addMass(std::vector<Channel>& out, int mass, int parameterCount) {
  const std::string id = fmt::format("mass{}", mass);
  const std::string what = fmt::format("simulated mass {}", mass);
  addVector(out, {id + "_pos", id + "_{}_m", "POS", id, "m", what + ", position"});
  addVector(out, {id + "_vel", id + "_v{}_m_per_s", "VEL", id, "m/s", what + ", velocity"});
  addVector(out, {id + "_acc", id + "_a{}_m_per_s2", "ACCEL", id, "m/s^2", what + ", acceleration"});
  for (int k = 1; k <= parameterCount; ++k)
    addScalar(out, {fmt::format("{}_q{}", id, k), fmt::format("{}_q{}", id, k), "MISC", id, "n/a", what + ", constraint parameter"});
  for (int k = 1; k <= parameterCount; ++k)
    addScalar(out, {fmt::format("{}_q{}_rate", id, k), fmt::format("{}_q{}_per_s", id, k), "MISC", id, "1/s",
                    what + ", rate of the constraint parameter"});
}

void addBody(std::vector<Channel>& out) {
  const char* description = "simulated body, orientation in the world frame as a unit quaternion";
  for (const char* part : {"w", "x", "y", "z"})
    out.push_back({fmt::format("body_quat_{}", part), fmt::format("quat_{}", part), "ORNT", "mass1", "n/a", description,
                   fmt::format("body_quat_{}", part)});
  addVector(out, {"body_gyro", "body_w{}_rad_per_s", "GYRO", "mass1", "rad/s", "simulated body, angular velocity in the world frame"});
}

// The vectors of a hand, in the order of `putVectors`. `number`: empty for the first hand.
void addHandVectors(std::vector<Channel>& out, const std::string& number, const std::string& whose, const std::string& coupled) {
  const std::string hand = "hand" + number, device = "device" + number, before = number.empty() ? "" : hand + "_";
  addVector(out, {hand + "_pos", hand + "_{}_m", "POS", hand, "m", whose + "haptic interface point as the coupling sees it"});
  addVector(out, {hand + "_vel", hand + "_v{}_m_per_s", "VEL", hand, "m/s", whose + "haptic interface point, estimated velocity"});
  addVector(out, {device + "_pos", device + "_{}_m", "POS", device, "m", whose + "haptic interface point, raw device position"});
  addVector(out,
            {before + "coupling_force", before + "coupling_{}_n", "MISC", coupled, "N", whose + "coupling force on the object, unclamped"});
  addVector(out, {before + "feedback_force", before + "feedback_{}_n", "MISC", hand, "N",
                  whose + "force meant for the hand, before the safety limits"});
  addVector(out, {before + "device_force", before + "device_force_{}_n", "MISC", hand, "N", whose + "force commanded to the device"});
}

// A further hand's own columns, in the order of `fillRow`.
constexpr std::size_t kHandColumns = 20;
void addHand(std::vector<Channel>& out, int number) {
  const std::string hand = fmt::format("hand{}", number), whose = fmt::format("hand {}: ", number);
  addHandVectors(out, std::to_string(number), whose, hand);
  addScalar(out, {hand + "_valid", hand + "_valid", "MISC", "n/a", "n/a", whose + "1 while the device delivers samples"});
  addScalar(out, {hand + "_work", hand + "_work_j", "MISC", hand, "J", whose + "work done on the object in this trial"});
}

constexpr std::size_t kTrialColumn = 21;  // latency, measured time, six vectors, energy

double* putVector(double* at, const Vec3& v) noexcept {
  at[0] = v.x;
  at[1] = v.y;
  at[2] = v.z;
  return at + 3;
}

double* putVectors(double* at, const haptics::HandState& hand) noexcept {
  for (const Vec3& v :
       {hand.hip.position, hand.hip.velocity, hand.device.position, hand.couplingForce, hand.feedbackForce, hand.deviceForce})
    at = putVector(at, v);
  return at;
}

}  // namespace

std::size_t ChannelTable::indexOf(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(), [&](const Channel& c) { return c.name == name; });
  if (found == channels.end()) throw FaultError(Fault{.what = "no channel named " + name});
  return static_cast<std::size_t>(found - channels.begin());
}

ChannelTable makeChannelTable(const experiment::Experiment& experiment, int parameterCount, bool portEnergy) {
  ChannelTable table;
  table.portEnergy = portEnergy;
  table.massCount = static_cast<int>(experiment.object.masses.size());
  table.parameterCount = parameterCount;
  table.body = experiment.object.kind == experiment::ObjectKind::Body;
  auto& out = table.channels;
  addScalar(out, {"latency", "time_s", "LATENCY", "n/a", "s",
                  "time in ticks of 1 ms, the clock of protocol and physics; in exported files since the first sample, as events"});
  addScalar(out, {"measured_time", "measured_s", "MISC", "n/a", "s", "monotonic clock of the computer, from the same moment as latency"});
  addHandVectors(out, "", "", "mass1");
  addScalar(out, {"energy", "energy_j", "MISC", "n/a", "J", "kinetic, elastic and gravity energy of object and coupling"});
  addScalar(out, {"trial", "trial", "MISC", "n/a", "n/a",
                  "trial number within the block, from 1; it stays until the next trial begins (phase 4); 0 before the first trial"});
  addScalar(out, {"phase", "phase", "MISC", "n/a", "n/a", "0 idle, 1 waiting, 2 armed, 3 moving, 4 done"});
  addScalar(out, {"valid", "valid", "MISC", "n/a", "n/a", "1 while the device delivers samples"});
  for (int mass = 1; mass <= table.massCount; ++mass) addMass(out, mass, parameterCount);
  if (table.body) addBody(out);
  table.hands = std::max(1, static_cast<int>(experiment.hands.size()));
  if (portEnergy)
    addScalar(out, {"port_energy", "port_energy_j", "MISC", "hand", "J",
                    "energy that the hand has given to the program in this trial (passivity observer); below 0 it was given some"});
  if (table.hands > 1)
    addScalar(out, {"hand_work", "hand_work_j", "MISC", "hand", "J", "work done by the hand on the object in this trial"});
  for (int hand = 2; hand <= table.hands; ++hand) addHand(out, hand);
  if (!experiment.environment.empty()) table.environment = true;
  if (experiment.cursor) table.cursor = true;
  if (table.environment)
    addVector(out, {"environment_force", "environment_{}_n", "MISC", "hand", "N",
                    "force of the environment on the hand, before the safety limits"});
  if (table.cursor)
    addVector(out, {"cursor_pos", "cursor_{}_m", "POS", "cursor", "m", "cursor of the hand, without the delay of the picture"});
  return table;
}

experiment::Experiment channelsOfAll(std::span<const experiment::CompiledExperiment> scenes) {
  experiment::Experiment all = scenes.front().experiment();
  for (const experiment::CompiledExperiment& scene : scenes) {
    if (all.environment.empty()) all.environment = scene.experiment().environment;
    if (!all.cursor) all.cursor = scene.experiment().cursor;
  }
  return all;
}

std::size_t rowWidth(const ChannelTable& t) {
  const std::size_t hands = t.hands > 1 ? 1 + static_cast<std::size_t>(t.hands - 1) * kHandColumns : 0;
  return kTrialColumn + 3 + static_cast<std::size_t>(t.massCount) * static_cast<std::size_t>(9 + 2 * t.parameterCount) + (t.body ? 7 : 0) +
         (t.portEnergy ? 1 : 0) + hands + (t.environment ? 3 : 0) + (t.cursor ? 3 : 0);
}

void fillRow(const ChannelTable& table, const haptics::TickState& state, double* row) noexcept {
  double* at = row;
  *at++ = secondsOf(state.tick);
  *at++ = static_cast<double>(state.measuredNs) * 1e-9;
  const haptics::HandState& first = state.hands[0];
  at = putVectors(at, first);
  *at++ = state.energy;
  *at++ = state.trial;
  *at++ = static_cast<double>(state.phase);
  *at++ = first.device.valid ? 1 : 0;
  for (int i = 0; i < table.massCount; ++i) {
    const dynamics::MassState& mass = state.masses[static_cast<std::size_t>(i)];
    at = putVector(at, mass.r);
    at = putVector(at, mass.v);
    at = putVector(at, mass.a);
    for (int k = 0; k < table.parameterCount; ++k) *at++ = mass.q[static_cast<std::size_t>(k)];
    for (int k = 0; k < table.parameterCount; ++k) *at++ = mass.qRate[static_cast<std::size_t>(k)];
  }
  if (table.body) {
    for (const double part : state.body.orientation) *at++ = part;
    at = putVector(at, state.body.angularVelocity);
  }
  if (table.portEnergy) *at++ = first.portEnergy;
  if (table.hands > 1) *at++ = first.work;
  for (int i = 1; i < table.hands; ++i) {
    const haptics::HandState& hand = state.hands[static_cast<std::size_t>(i)];
    at = putVectors(at, hand);
    *at++ = hand.device.valid ? 1 : 0;
    *at++ = hand.work;
  }
  if (table.environment) at = putVector(at, state.environment.force);
  if (table.cursor) at = putVector(at, state.environment.cursor);
}

void numberTrial(const ChannelTable&, int firstTrial, double* row) noexcept {
  if (row[kTrialColumn] > 0) row[kTrialColumn] += firstTrial - 1;
}

}  // namespace reachlab::record
