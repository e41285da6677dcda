#pragma once
#include "analysis/dataset.h"
#include "gui/scene_plan/scene_plan.h"
#include "sim/record/log/run_log.h"

namespace reachlab::gui::inspector {

/// The recorded states of one trial at any time, with straight lines between its rows. Nothing is simulated.
class TrialReplay {
 public:
  TrialReplay() = default;
  /// Reads the trial's rows from its arming to its end. Throws the errors of reading rows.
  TrialReplay(const analysis::RunSource& run, const record::RecordedTrial& trial);
  bool empty() const { return rows_.size() == 0; }
  /// Of the first and the last row. [s] since arming
  double begin() const { return empty() ? 0 : timeOf(0); }
  double end() const { return empty() ? 0 : timeOf(rows_.size() - 1); }
  /// The row's time before or after `time`, for stepping. [s]
  double neighbour(double time, int rows) const;
  /// Held beyond the ends.
  scene::SceneFrame frameAt(double time) const;
  double forceAt(double time) const;  // [N] of the coupling; without an object, of the environment

 private:
  double timeOf(std::size_t row) const;
  std::size_t rowBefore(double time) const;

  record::SampleRows rows_;
  std::uint64_t zero_ = 0;  // tick of t = 0
  std::size_t hand_ = 0, force_ = 0, valid_ = 0, mass_ = 0, massStep_ = 0, massCount_ = 0, body_ = 0;
  bool isBody_ = false;
};

}  // namespace reachlab::gui::inspector
