#pragma once
#include <memory>
#include <string>

#include "constraints/constraint_spec.h"
#include "sim/experiment/experiment_fwd.h"

namespace reachlab::experiment {

/// An experiment without faults, with its constraint compiled once. Protocol, scene, prediction, device and picture are made from it.
/// A value, cheap to copy: window, haptic engine and predictions in the background share the two parts, which never change. Any thread.
class CompiledExperiment {
 public:
  /// Throws FaultError with every fault, each under its key.
  explicit CompiledExperiment(const Experiment& experiment);
  /// The same for a value that was made from `origin`: as long as its constraint is the same, nothing is compiled again.
  CompiledExperiment(const Experiment& experiment, const CompiledExperiment& origin);

  const Experiment& experiment() const { return *experiment_; }
  const constraints::Constraint& constraint() const { return *constraint_; }

 private:
  CompiledExperiment(Experiment experiment, std::shared_ptr<const constraints::Constraint> constraint);
  friend CompiledExperiment openExperimentText(const std::string& text, const std::string& file, const std::string& definition);

  std::shared_ptr<const Experiment> experiment_;
  std::shared_ptr<const constraints::Constraint> constraint_;
};

/// Reads and compiles an experiment file, or a shipped one by name. Throws FaultError with every fault, each with its place.
CompiledExperiment openExperiment(const std::string& fileOrName);
/// The same from text. `file` is only named in messages. `definition`: see parseExperiment.
CompiledExperiment openExperimentText(const std::string& text, const std::string& file, const std::string& definition = {});

}  // namespace reachlab::experiment
