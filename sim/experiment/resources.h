#pragma once
#include <optional>
#include <string>
#include <vector>

namespace reachlab::experiment {

/// Names of the files that the program brings of one kind ("experiments", "plans"), in order, without their ending; none where
/// there is no such folder. Throws ResourceError when the resources are not found.
std::vector<std::string> shippedNames(const std::string& kind);
/// The file of a shipped experiment, for one hand or for two; nullopt: none has that name.
std::optional<std::string> shippedExperimentFile(const std::string& name);

}  // namespace reachlab::experiment
