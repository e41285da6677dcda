#pragma once
#include <string>
#include <vector>

#include "sim/dynamics/method_choice.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/session/block_scenes.h"
#include "sim/session/plan.h"

namespace reachlab::session {

/// The content of a session: one experiment, or a plan with the experiments of its blocks. It is a value that is read once. No file is read
/// again, however often it is recorded.
struct Programme {
  Plan plan;                                                // a single experiment has one block and no text
  std::vector<experiment::CompiledExperiment> experiments;  // one for each of plan.blocks
  std::vector<std::vector<BlockScene>> scenes;              // of each of plan.blocks, one or more
  bool isPlan() const { return !plan.text.empty(); }
};

/// Reads a plan or an experiment: a file, or a shipped name. Each experiment of a plan is compiled once, and its task and its
/// scenes can be carried out. Throws FaultError with every fault, each at its position, and RefusedError for a single experiment whose scene
/// cannot be computed.
Programme readProgramme(const std::string& fileOrName);
/// The same of a plan's text, as it would be in this file.
Programme parseProgramme(const std::string& text, const std::string& file);
/// Warnings of a scene and of the method that it is computed by, under their keys: numbers that are hardly meant, a way that rounding
/// decides, and errors of the method that a person would not expect.
std::vector<Fault> warningsOf(const experiment::CompiledExperiment& scene, const dynamics::MethodChoice& choice);
/// The experiment that every station of a session runs. Throws FaultError for a plan.
const experiment::CompiledExperiment& experimentOfStations(const Programme& programme);
/// A single experiment, as it is edited in a window or made by a program.
Programme programmeOf(const experiment::CompiledExperiment& experiment);

}  // namespace reachlab::session
