#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// The verdict on one number of an experiment for a device.
enum class Verdict {
  Fine,
  Held,     // fine only while somebody holds the device
  Warning,  // the felt force will differ from the computed force
  Unknown,  // the device does not tell its limit
};
std::string_view nameOf(Verdict verdict);  // "fine", "held", …

/// One row of the check: the demand of the experiment, the limit of the device, and the remedy.
struct PreflightLine {
  std::string name;  // "peak_force", "continuous_force", "passivity", "stability", "channel", "field_power", "workspace"
  Verdict verdict = Verdict::Fine;
  double asked = 0;             // in `unit`
  std::optional<double> limit;  // nullopt: unknown
  std::string unit;             // "N", "N s/m", "N/m", "W", "m"
  std::string sentence;         // the numbers as a sentence
  std::string remedy;           // empty where nothing is to be done
  int hand = 0;                 // the hand, from 1; 0: there is only one hand
};

/// The demands of a block of this experiment on this device:
///   peak_force        largest force of a reach against DeviceInfo::maxForce (an experiment's lower limit holds)
///   continuous_force  root mean square of the movement's force against what the motors stand for ever, trials without a pause
///   passivity         Colgate and Schenkel: the friction K T/2 + |B| that is asked against the device's own viscous friction, T the slower
///                     of tick and reports. Encoder steps: Abbott and Okamura 2005, K <= 2 c/resolution with Coulomb friction c
///   stability         k_h against the largest that dies out on this device held by a relaxed hand (0.3 kg, 3 N s/m)
///   channel           its stiffness, beside that of the object, against the largest that dies out on this device held by a relaxed hand,
///                     with the damping of the wall; Colgate's friction is named
///   field_power       of a viscous field that does no work at exact velocity: b v^2 sin(w d) on the circle over start and target, there and
///                     back in 2 T, with the delay d of the velocity estimate; against v^2 times the friction of device and lightest hand
///   workspace         farthest place of the hand against the device's radius
/// For a device without force only the workspace is checked. Takes some milliseconds, on a curve up to seconds. Throws FaultError (no task)
/// or RefusedError (the scene cannot be computed). `hand` is the hand of the experiment that holds the device, from 0.
std::vector<PreflightLine> checkBeforeBlock(const experiment::CompiledExperiment& experiment, const haptics::DeviceInfo& device,
                                            std::size_t hand = 0);
/// The rows of every hand of a device, hand by hand.
std::vector<PreflightLine> checkBeforeBlock(const experiment::CompiledExperiment& experiment, haptics::HapticDevice& device);

/// One sentence for a row that is not fine, with its remedy: "peak force: …; …", "hand 2: peak force: …; …".
std::string describe(const PreflightLine& line);
/// The messages before a block of these scenes, each sentence once: the warnings of those hands that feel a force. Empty without a task.
std::vector<std::string> warningsBeforeBlock(std::span<const experiment::CompiledExperiment> scenes, haptics::HapticDevice& device);

}  // namespace reachlab::devices
