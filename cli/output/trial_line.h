#pragma once
#include <string>

#include "sim/record/configuration/run_configuration.h"
#include "sim/trial/outcome.h"

namespace reachlab::cli {

/// `trial=3 kind=field target=2 outcome=failure reason=velocity mass=5 by=0.004 time_s=1.31`. Parts that do not apply are left out.
std::string trialLine(int trial, const trial::TrialResult& result, const record::RunScene* scene = nullptr);

}  // namespace reachlab::cli
