#pragma once
#include <functional>

#include "analysis/study/study_folder.h"
#include "analysis/study/subject_hands.h"

namespace reachlab::study {

/// What is told while chunks are computed, from whichever thread has come so far, one at a time.
struct StudyProgress {
  std::int64_t trialsDone = 0, trials = 0;  // of this share; with those that were there before
  std::int64_t trialsNow = 0;               // computed since the start
  double seconds = 0;                       // since the start
  double rate() const { return seconds > 0 ? static_cast<double>(trialsNow) / seconds : 0; }
  double secondsLeft() const { return rate() > 0 ? static_cast<double>(trials - trialsDone) / rate() : 0; }
};
using TellProgress = std::function<void(const StudyProgress& progress)>;

/// Where the next chunk to compute comes from; nullopt: none is left. Called from any thread.
using NextChunk = std::function<std::optional<std::int64_t>()>;

/// Computes chunk after chunk on `jobs` threads until none is left, each safe on the disk before the next. `done` is called for each subject,
/// from one thread at a time. The first fault ends all threads and is thrown. A program that is ended at any moment loses no chunk that is
/// there.
void computeChunks(const StudyFolder& folder, const PrepareSubjects& prepare, unsigned jobs, const NextChunk& next,
                   const std::function<void(std::int64_t trials)>& done);

/// The missing chunks of one share, on `jobs` threads.
void computeShard(const StudyFolder& folder, const PrepareSubjects& prepare, unsigned jobs, const Shard& shard, const TellProgress& tell);

/// Looks at points of the design (all of a small one, else some from everywhere) as far as they are cheap to look at, so that what is wrong
/// is told before the night. Throws FaultError, RefusedError naming the point.
void checkPoints(const Design& design, const PrepareSubjects& prepare);

}  // namespace reachlab::study
