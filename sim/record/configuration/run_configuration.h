#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/task.h"
#include "sim/record/configuration/channels.h"
#include "sim/trial/planned_trial.h"

namespace reachlab::record {

/// Facts about a person, whose pseudonym is the subject label. Empty or nullopt: not given.
struct Participant {
  std::optional<double> age;  // [years]
  std::string sex;            // F | M | O
  std::string handedness;     // R | L | A
  bool operator==(const Participant&) const = default;
};

/// A kind of trial to one target, of a block that has several (docs/reference/plan.md).
struct RunScene {
  std::string kind;            // empty: the block has no kinds
  std::string target;          // "3"; "3-back" on the way back from it; empty: the block has no targets
  std::string condition;       // of its trials in every table
  std::string experimentText;  // what holds in its trials
  std::string method, methodReason;
};

/// The first record of a log: everything that is needed to understand the run and to compute it again. A plain value. Its fields are read,
/// written and compared by one list, in run_fields.h.
struct RunConfiguration {
  std::string subject = "01", session = "01", task = "reach";
  int run = 1;         // as in the file name
  int firstRun = 1;    // the run that this one resumes, or itself: together they are one block
  int firstTrial = 1;  // the number of this run's first trial; a resumed block goes on counting
  int block = 1;       // within the session's plan, from 1; 1 without a plan
  bool practice = false;
  std::string condition;                       // of the plan; empty: the experiment's name
  int day = 0;                                 // of the plan; 0: none
  double pauseSeconds = 0;                     // between trials
  bool repeatAborted = false;                  // an aborted trial is put up once more at the end
  std::string experimentName, experimentText;  // the file as it was read
  std::string definitionText;                  // of the named constraint, see definitionTextOf; empty for a typed formula and free space
  std::string planName, planText;              // empty without a plan
  std::uint64_t seed = 0;                      // of this block: trial i depends on (seed, i) alone
  std::uint64_t sessionSeed = 0;               // that the blocks' seeds come from
  std::uint64_t orderSeed = 0;                 // of the plan
  std::vector<trial::PlannedTrial> trials;
  std::optional<std::vector<RunScene>> scenes;  // PlannedTrial::scene is one of them; nullopt: all trials are done in `experimentText`
  std::string device;                           // as asked for: "simulated:noise=0"; several hands' as "A + B"
  haptics::DeviceInfo firstHand;                // its device, as far as the list of fields has it
  std::vector<haptics::DeviceInfo> otherHands;  // the same of the second hand on
  experiment::TimingLimits timing = experiment::kNoTimingLimits;  // that the trials were judged by
  experiment::StartRest rest = experiment::kNoStartRest;          // that a trial asked for before it was armed
  std::string instruments;                                        // InstrumentLink::names; empty: none
  std::string method, methodReason;                               // what the scene was compiled to
  std::string softwareVersion, buildDescription, computer;
  std::string startedUtc;        // ISO 8601 with milliseconds
  std::string clock = "steady";  // or virtual: as fast as the processor allows
  double samplingHz = 100;       // of the sample rows
  std::uint32_t sampleEveryTicks = 10;
  Participant participant;
  std::string notes;  // by the experimenter
  ChannelTable table;
};

/// The condition of the run as a whole: that of the plan, else the experiment's name.
inline const std::string& conditionOf(const RunConfiguration& c) { return c.condition.empty() ? c.experimentName : c.condition; }
/// The scene of a trial. Null where the run has only one scene.
inline const RunScene* sceneOf(const RunConfiguration& c, const trial::PlannedTrial& planned) {
  return c.scenes ? &c.scenes->at(static_cast<std::size_t>(planned.scene)) : nullptr;
}
/// The condition of a trial: its kind and target, where the run has several, else that of the run.
inline const std::string& conditionOf(const RunConfiguration& c, const trial::PlannedTrial& planned) {
  const RunScene* scene = sceneOf(c, planned);
  return scene != nullptr ? scene->condition : conditionOf(c);
}

/// The devices of all hands, the first hand's at index 0.
std::vector<haptics::DeviceInfo> devicesOf(const RunConfiguration& configuration);

std::string toJson(const RunConfiguration& configuration);
/// Throws FaultError naming `origin` when the text is no configuration, or a configuration that no recording could have
/// (checkConfiguration).
RunConfiguration configurationFromJson(std::string_view text, const std::string& origin);

/// The experiment that was recorded, with the constraint as it was then: neither the catalogue nor the user's folder is asked.
/// Throws FaultError when its text cannot be understood.
experiment::CompiledExperiment recordedExperiment(const RunConfiguration& configuration);
/// The same of every scene, in their order. A run of one scene has one value.
std::vector<experiment::CompiledExperiment> recordedScenes(const RunConfiguration& configuration);
/// The same for a reader that only describes the experiment: its constraint is not compiled. Throws FaultError when its text cannot be
/// understood.
experiment::Experiment recordedValues(const RunConfiguration& configuration);
/// The same of a trial's scene.
experiment::Experiment recordedValues(const RunConfiguration& configuration, const trial::PlannedTrial& planned);

/// The names of channels behind those of the scene (FurtherColumns) begin so.
inline constexpr std::string_view kFurtherName = "station";

/// Checks that a configuration from a file is consistent. Labels are labels, since they become names of files. Every count is within its
/// bounds. The table has the channels that its counts ask for, followed only by further channels. Throws FaultError.
void checkConfiguration(const RunConfiguration& configuration);

/// Returns the fault of the label under `key`, if any. A label has letters and digits only (BIDS), at most 60.
std::optional<Fault> labelFault(const std::string& label, const std::string& key);
inline constexpr double kMaxAge = 130;  // [years]
/// Returns the fault of an age outside 0 to kMaxAge, so that the record can be written and read.
std::vector<Fault> problems(const Participant& participant);

}  // namespace reachlab::record
