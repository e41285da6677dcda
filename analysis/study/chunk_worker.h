#pragma once
#include <deque>
#include <memory>
#include <set>
#include <string>

#include "analysis/study/chunk.h"
#include "analysis/study/measurer.h"
#include "analysis/study/points.h"
#include "analysis/study/subject_hands.h"

namespace reachlab::study {

/// Computes chunks, one at a time, and keeps what the last points had in common: experiments compiled, plans and gains made, predictions.
/// One thread; as many workers as threads.
class ChunkWorker {
 public:
  ChunkWorker(const Design& design, PrepareSubjects prepare);

  /// `stop` is looked at between subjects; when it is true the chunk is left (nullopt). Throws FaultError (a point that is no experiment),
  /// RefusedError (one that cannot be computed), each naming the point.
  std::optional<ChunkRows> compute(const PairRange& pairs, const std::function<bool(std::int64_t trials)>& goOn);

 private:
  /// An experiment with everything that its subjects share.
  struct Kit {
    std::string device, text;
    std::optional<experiment::CompiledExperiment> experiment;
    SubjectHands hands;
    std::unique_ptr<Measurer> measurer;
    std::unique_ptr<BlockRun> run;
  };
  Kit& kitFor(const std::string& device, const PointExperiment& experiment);
  void computeSubject(std::int64_t subject, std::vector<MeasuredTrial>& trials, std::vector<double>& identity);

  const Design& design_;
  PrepareSubjects prepare_;
  Needs needs_;
  std::vector<Column> columns_;
  std::size_t identity_;
  std::optional<Point> point_;
  PointTask task_;
  std::deque<Kit> kits_;  // newest first
};

/// Throws FaultError, RefusedError where a point is no experiment, or its subject has no plan. What was looked at is added to `seen` and not
/// looked at again.
void checkPoint(const Design& design, std::int64_t index, const PrepareSubjects& prepare,
                std::set<std::pair<std::string, std::string>>& seen);

}  // namespace reachlab::study
