#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/patch.h"

namespace reachlab::session {

/// A series of trials with the same settings; recorded as one run.
struct PlanBlock {
  std::string experiment;                  // file (beside the plan) or shipped name
  std::vector<experiment::Patch> changes;  // to that file; the condition then has a name
  int trials = 1;
  bool practice = false;                        // recorded too, left out of statistics
  double pauseSeconds = 0;                      // [s] between trials
  std::string condition;                        // empty: the experiment's name
  int day = 0;                                  // 0: every day
  double foreperiodMin = 0, foreperiodMax = 0;  // [s] from arming to the go signal, drawn evenly
  double catchShare = 0;                        // of the trials, without a go signal
  bool repeatAborted = false;                   // a trial that was aborted is put up once more at the end of the block
  double restSeconds = 0;                       // [s] of rest, at least, between the block before and this one
  std::string instructions;                     // to be read before the block begins
};

/// How the order of a day's blocks differs between subjects. `Permute`: the blocks that are not practice take the subject's row
/// of a balanced table (all orders of up to 4 conditions, else a Latin square); practice blocks stay where they are.
enum class Counterbalance { None, Permute };

/// A session plan, as read from a file. Keys given for the plan as a whole hold for every block that does not give them itself.
struct Plan {
  std::string name, text;
  std::uint64_t orderSeed = 0;
  Counterbalance counterbalance = Counterbalance::None;
  std::vector<PlanBlock> blocks;
};

/// The condition's name, where it is not given that of the experiment's file.
std::string conditionOf(const PlanBlock& block);
/// The block's experiment with its changes. Throws FaultError; what is wrong with a change is told under `change.KEY`.
experiment::CompiledExperiment openExperimentOf(const PlanBlock& block);

/// True when the text is a plan and not an experiment: an object with a member `blocks`.
bool isPlan(const std::string& text, const std::string& file);
/// The file that `fileOrName` means: itself if it exists, else the shipped plan of that name; nullopt when neither.
std::optional<std::string> findPlan(const std::string& fileOrName);
/// Names of the shipped plans, in order.
std::vector<std::string> shippedPlans();
/// Throws FaultError with every fault, `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
Plan parsePlan(const std::string& text, const std::string& file);
Plan readPlan(const std::string& file);
/// The plan as a file that reads back equal. Experiments are named as they stand in the blocks.
std::string toJson(const Plan& plan);
/// Every fault of a plan as a value, each under its key; empty when fine.
std::vector<Fault> problems(const Plan& plan);

/// The blocks of `day` (every block when 0) in the order that this subject does them: indices into plan.blocks. A function of the
/// plan and the subject's label alone.
std::vector<int> blockOrder(const Plan& plan, const std::string& subject, int day);

}  // namespace reachlab::session
