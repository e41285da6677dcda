#pragma once
#include <functional>

#include "analysis/study/study_folder.h"

namespace reachlab::study {

/// The progress of a study. Any thread may report it, one at a time.
struct StudyProgress {
  std::int64_t trialsDone = 0, trials = 0;  // of this share; with those that were there before
  std::int64_t trialsNow = 0;               // computed since the start
  double seconds = 0;                       // since the start
  double rate() const { return seconds > 0 ? static_cast<double>(trialsNow) / seconds : 0; }
  double secondsLeft() const { return rate() > 0 ? static_cast<double>(trials - trialsDone) / rate() : 0; }
};
using TellProgress = std::function<void(const StudyProgress& progress)>;

/// Gives the next chunk to compute, or nullopt if no chunk is left. Called from any thread.
using NextChunk = std::function<std::optional<std::int64_t>()>;

/// Computes chunk after chunk on `jobs` threads until no chunk is left. Each chunk is safe on the disk before the next begins. `done` is
/// called for each subject, from one thread at a time. The first fault ends all threads and is thrown. If the program is ended at any
/// moment, finished chunks are kept.
void computeChunks(const StudyFolder& folder, unsigned jobs, const NextChunk& next, const std::function<void(std::int64_t trials)>& done);

/// Runs `work` with the missing chunks of one share. `next` gives them and `done` counts trials and tells the progress, both from any thread.
using ComputeAll = std::function<void(const NextChunk& next, const std::function<void(std::int64_t trials)>& done)>;
void workThrough(const StudyFolder& folder, const Shard& shard, const TellProgress& tell, const ComputeAll& work);

/// The missing chunks of one share, on `jobs` threads.
void computeShard(const StudyFolder& folder, unsigned jobs, const Shard& shard, const TellProgress& tell);

/// Checks points of the design before a long computation: all points of a small design, otherwise a sample. Only cheap checks are made.
/// Throws FaultError or RefusedError, which name the point.
void checkPoints(const Design& design);

}  // namespace reachlab::study
