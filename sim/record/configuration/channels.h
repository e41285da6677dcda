#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment_fwd.h"
#include "sim/experiment/object.h"
#include "sim/haptics/tick_state.h"

namespace reachlab::record {

/// One column of the recording, as BIDS channels.tsv describes it.
struct Channel {
  std::string name;          // "hand_pos_x", "mass3_vel_y"
  std::string component;     // x | y | z | n/a
  std::string type;          // LATENCY | POS | VEL | ACCEL | MISC
  std::string trackedPoint;  // hand | device | mass1 … | n/a
  std::string units;         // s | m | m/s | m/s^2 | N | J | n/a …
  std::string description;
  std::string column;  // its name in CSV files, with the unit: "hand_x_m"
};

/// The channels of a scene, in the order of fillRow. First come time, hand (estimated), device (raw), forces of coupling, feedback and
/// device, energy, phase, trial and validity. Position, velocity, acceleration and constraint parameters of each mass follow. The columns
/// of further hands are last.
struct ChannelTable {
  std::vector<Channel> channels;
  int massCount = 0;
  int parameterCount = 0;           // constraint parameters of a mass: 0, 1 or 2
  bool body = false;                // orientation and angular velocity follow
  bool portEnergy = false;          // of a device that renders force: the passivity observer's energy is the next column
  std::optional<bool> environment;  // has a value where the force of the environment follows the hands
  std::optional<bool> cursor;       // has a value where the cursor follows
  int hands = 1;                    // with more than one, the first hand's work and then each other hand's own columns follow

  std::size_t size() const { return channels.size(); }
  /// Index of a channel; throws FaultError for an unknown name.
  std::size_t indexOf(const std::string& name) const;
};

/// `parameterCount` is Constraint::parameterCount() of the scene's constraint.
ChannelTable makeChannelTable(const experiment::Experiment& experiment, int parameterCount, bool portEnergy = false);

/// The first scene of a run, with the environment and the cursor of a scene that has them: the table of this experiment serves every scene.
experiment::Experiment channelsOfAll(std::span<const experiment::CompiledExperiment> scenes);
/// Numbers in a row of such a table.
std::size_t rowWidth(const ChannelTable& table);

/// Fills one row of the table with table.size() doubles. Measured time is that of the state, and the recorder subtracts the run's start.
/// Runs on the haptic thread and never allocates.
void fillRow(const ChannelTable& table, const haptics::TickState& state, double* row) noexcept;

/// Turns the engine's count of trials in a row (from 1, and 0 before trial 1) into trial numbers that begin with `firstTrial`.
void numberTrial(const ChannelTable& table, int firstTrial, double* row) noexcept;

}  // namespace reachlab::record
