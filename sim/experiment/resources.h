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

/// Names of the shipped experiments, sorted: those that one hand does with one device, and those for two.
std::vector<std::string> shippedExperiments();
std::vector<std::string> shippedForTwoHands();
/// Folder of resources: $REACHLAB_RESOURCES, else beside the source or installed. Throws ResourceError when there is none.
std::string resourceFolder();

}  // namespace reachlab::experiment
