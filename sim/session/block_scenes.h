#pragma once
#include <string>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/session/plan.h"

namespace reachlab::session {

/// The names of a scene, as in record::RunScene. All are empty but the condition in a plain block.
struct SceneName {
  std::string kind, target, condition;
};
/// One kind of trial to one target, as an experiment.
struct BlockScene : SceneName {
  experiment::CompiledExperiment experiment;
};

/// The names of a block's scenes in their order. A plain block has one. Otherwise scene i = kind * targets + target is the way out, or with
/// ways back scenes 2 i and 2 i + 1 are out and back.
std::vector<SceneName> sceneNames(const PlanBlock& block);
/// The scenes of a block, whose experiment (with the block's changes) is `experiment`, in the same order. Throws FaultError, with keys
/// below the block's: a change that the experiment refuses, a target outside the domain, scenes that cannot share a record.
std::vector<BlockScene> scenesOf(const PlanBlock& block, const experiment::CompiledExperiment& experiment);

}  // namespace reachlab::session
