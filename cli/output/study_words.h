#pragma once
#include <cstdint>
#include <string>

#include "analysis/study/run_study.h"

namespace reachlab::cli {

/// "I/N", or the share of this task of a Slurm array where that is empty, else all. Throws FaultError.
study::Shard shardOf(const std::string& text);

/// The subjects of this program's simulated device.
study::PrepareSubjects prepareSimulated();

/// Progress with rate and time left on stderr: a line that is rewritten on a terminal, and a line from time to time in a log.
class ProgressLine {
 public:
  ProgressLine();
  void tell(const study::StudyProgress& progress);
  void end();

 private:
  bool terminal_, told_ = false;
  std::int64_t nextNs_ = 0;
};

/// "1 h 02 min", "3 min 20 s", "12 s".
std::string describeSeconds(double seconds);

}  // namespace reachlab::cli
