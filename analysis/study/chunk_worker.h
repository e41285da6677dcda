#pragma once
#include <deque>
#include <memory>
#include <set>
#include <string>

#include "analysis/study/chunk.h"
#include "analysis/study/measurer.h"
#include "analysis/study/points.h"
#include "sim/subjects/plans/simulated_hand.h"

namespace reachlab::study {

/// Computes chunks, one at a time. It keeps compiled experiments, plans, gains and predictions for the next points. Each thread has its
/// worker.
class ChunkWorker {
 public:
  explicit ChunkWorker(const Design& design);

  /// `goOn` is asked between subjects. If it answers false, the chunk is left and the result is nullopt. Throws FaultError for a point that
  /// is no experiment and RefusedError for a point that cannot be computed. Both name the point.
  std::optional<ChunkRows> compute(const PairRange& pairs, const std::function<bool(std::int64_t trials)>& goOn);

 private:
  /// The scenes of a block with everything that its subjects share.
  struct Kit {
    std::string device, text;
    std::vector<experiment::CompiledExperiment> scenes;
    subjects::MakeSubject hands;
    std::vector<std::unique_ptr<Measurer>> measurers;  // of each scene
    std::unique_ptr<BlockRun> run;
  };
  Kit& kitFor(const std::string& device, const PointExperiment& experiment, const session::PlanBlock& block);
  void computeSubject(std::int64_t subject, std::vector<MeasuredTrial>& trials, std::vector<double>& identity);

  const Design& design_;
  Needs needs_;
  std::vector<Column> columns_;
  std::size_t identity_;
  std::optional<Point> point_;
  PointTask task_;
  std::deque<Kit> kits_;  // newest first
};

/// Throws FaultError, RefusedError where a point is no experiment, or its subject has no plan. Checked devices and experiments are added to
/// `seen` and not checked again.
void checkPoint(const Design& design, std::int64_t index, std::set<std::pair<std::string, std::string>>& seen);

}  // namespace reachlab::study
