#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/patch.h"
#include "sim/session/mix/trial_mix.h"

namespace reachlab::session {

inline constexpr int kMaxTrials = 1'000'000;
inline constexpr int kMaxDay = 10'000;
inline constexpr double kMaxPause = 86'400;   // [s] between trials, and of a rest before a block. A longer one is another session
inline constexpr double kMaxForeperiod = 60;  // [s]
inline constexpr double kMaxCatchShare = 0.5;
inline constexpr double kMaxOrderSeed = 9'007'199'254'740'992.0;  // 2^53: a number in JSON is read as a double

/// A series of trials with the same settings, recorded as one run.
struct PlanBlock {
  std::string experiment;                       // file (beside the plan) or shipped name
  std::vector<experiment::Patch> changes;       // to that file. The condition then has a name
  int trials = 1;                               // without ways back
  bool practice = false;                        // recorded too, left out of statistics
  double pauseSeconds = 0;                      // [s] between trials
  std::string condition;                        // empty: the experiment's name
  int day = 0;                                  // 0: every day
  double foreperiodMin = 0, foreperiodMax = 0;  // [s] from arming to the go signal, drawn evenly
  double catchShare = 0;                        // of the trials, without a go signal
  bool repeatAborted = false;                   // an aborted trial is repeated once at the end of the block
  double restSeconds = 0;                       // [s] of rest, at least, between the block before and this one
  std::string instructions;                     // to be read before the block begins
  TrialMix mix;                                 // kinds and targets of the trials
};

/// The rule by which the order of a day's blocks differs between subjects. `Permute`: blocks other than practice take the subject's row of
/// a balanced table. The table has all orders of up to 4 conditions, else a Latin square. Practice blocks keep their positions.
enum class Counterbalance { None, Permute };

/// A session plan, as read from a file. Keys of the whole plan hold for every block that does not give them itself.
struct Plan {
  std::string name, text;
  std::uint64_t orderSeed = 0;
  Counterbalance counterbalance = Counterbalance::None;
  std::vector<PlanBlock> blocks;
};

/// The condition's name. By default it is the name of the experiment's file.
std::string conditionOf(const PlanBlock& block);
/// The block's experiment with its changes. Throws FaultError, which names a wrong change as `change.KEY`.
experiment::CompiledExperiment openExperimentOf(const PlanBlock& block);

/// True when the text is a plan and not an experiment: an object with a member `blocks`.
bool isPlan(const std::string& text, const std::string& file);
/// The file that `fileOrName` means: itself if it is there and no folder, else the shipped plan of that name. Nullopt if both are missing.
std::optional<std::string> findPlan(const std::string& fileOrName);
/// Names of the shipped plans, in order.
std::vector<std::string> shippedPlans();
/// Throws FaultError with every fault, `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
Plan parsePlan(const std::string& text, const std::string& file);
Plan readPlan(const std::string& file);
/// The plan as a file that reads back equal. Experiments keep the names that the blocks use.
std::string toJson(const Plan& plan);
/// The key of a block's setting in a plan's file: that of the block, or of the plan where only the plan gives it.
std::string keyInPlan(const JsonNode& root, std::size_t block, const std::string& setting);
/// Every fault of a plan as a value, each under its key.
std::vector<Fault> problems(const Plan& plan);

/// The blocks of `day` (every block when 0) in this subject's order, as indices into plan.blocks. It depends on the plan and the subject's
/// label alone.
std::vector<int> blockOrder(const Plan& plan, const std::string& subject, int day);

}  // namespace reachlab::session
