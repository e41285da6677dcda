#pragma once
#include <optional>
#include <string>
#include <vector>

namespace reachlab::experiment {

/// Names of the files that the program brings of one kind ("experiments", "plans"), in order, without their ending. Empty if
/// there is no such folder. Throws ResourceError when the resources are not found.
std::vector<std::string> shippedNames(const std::string& kind);
/// The file of a shipped experiment, for one hand or for two; nullopt if the name is unknown.
std::optional<std::string> shippedExperimentFile(const std::string& name);

/// Sorted names of the shipped experiments for one hand with one device, and for two hands.
std::vector<std::string> shippedExperiments();
std::vector<std::string> shippedForTwoHands();
/// Folder of resources: $REACHLAB_RESOURCES, else beside the source or installed. Throws ResourceError if there is no such folder.
std::string resourceFolder();

}  // namespace reachlab::experiment
