#pragma once
#include <string>
#include <vector>

#include "sim/session/session.h"

namespace reachlab::session {

/// One block of a session, and how much of it is recorded.
struct BlockProgress {
  int block = 0;  // from 1, in this subject's order
  std::string condition, experiment;
  bool practice = false;
  int trials = 0, done = 0;
  double restSeconds = 0;
  std::string instructions;
  bool begun() const { return done > 0; }
  bool complete() const { return done >= trials; }
};

/// A session's blocks in this subject's order of this day, with their recorded parts.
struct SessionProgress {
  std::vector<BlockProgress> blocks;
  std::vector<std::string> unreadable;  // logs that are left out, a sentence each
  int blocksDone() const;
  bool begun() const;
  bool complete() const { return blocksDone() == static_cast<int>(blocks.size()); }
};

/// Looks at the disk, but opens and writes nothing. Throws the errors of planSession.
SessionProgress progressOf(const SessionRequest& request, const Programme& programme);

}  // namespace reachlab::session
