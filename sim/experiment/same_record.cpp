#include "sim/experiment/same_record.h"

#include "sim/experiment/experiment.h"

namespace reachlab::experiment {

std::optional<Fault> differenceInRecord(const Experiment& first, const Experiment& other) {
  const auto rest = [](const Experiment& e) { return e.task ? e.task->rest : StartRest{}; };
  const auto constraint = [](const Experiment& e) {
    constraints::ConstraintSpec spec = e.constraint;
    spec.inUse.reset();  // follows the target
    return spec;
  };
  const char* key = nullptr;
  if (constraint(first) != constraint(other)) key = "constraint";
  else if (first.object.kind != other.object.kind) key = "object.kind";
  else if (first.object.masses.size() != other.object.masses.size()) key = "object.masses_kg";
  else if (first.hands.size() != other.hands.size()) key = "hands";
  else if (first.velocityEstimator != other.velocityEstimator) key = "velocity_estimator";
  else if (first.forceLimit != other.forceLimit) key = "force_limit_n";
  else if (first.timing != other.timing) key = "timing";
  else if (first.task.has_value() != other.task.has_value()) key = "task";
  else if (rest(first) != rest(other)) key = "task.rest_s";
  if (key == nullptr) return std::nullopt;
  return Fault{key, "differs between the scenes of one run", "the same value in every kind of trial"};
}

}  // namespace reachlab::experiment
