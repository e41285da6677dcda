#pragma once
#include <string>

#include "analysis/study/run_study.h"

namespace reachlab::cli {

/// "I/N", or the share of this task of a Slurm array where that is empty, else all. Throws FaultError.
study::Shard shardOf(const std::string& text);

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string describeSeconds(double seconds);

/// "120 of 240 trials, 40 a second, 3 s left".
std::string describeProgress(const study::StudyProgress& progress);

}  // namespace reachlab::cli
