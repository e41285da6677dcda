#pragma once
#include <string>

#include "sim/predict/predict.h"

namespace reachlab::cli {

/// The criterion that `--criterion` names. Throws FaultError listing the names with the paper's numbers.
predict::Criterion parseCriterion(const std::string& name);

}  // namespace reachlab::cli
