#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "analysis/measures/recording_filter.h"

namespace reachlab::analysis {

/// A dimensionless hand velocity phi(s) on an even grid of s (0 onset, 1 end), 0 outside the grid. `change` is its derivative by the
/// logarithm of the planned duration, and is empty for a plan that is held.
struct Profile {
  double first = 0, step = 1;         // s of value[0], spacing
  std::vector<double> value, change;  // phi, d phi / d ln T

  double last() const { return first + step * static_cast<double>(value.size() - 1); }
  /// phi at s by cubic pieces with slopes of fourth order.
  double at(double s) const;
};

/// One candidate's hand velocity for every duration T: phi(s, T) = (T/L) v(sT). It is exact on a few durations and filtered there as a
/// recording is. Between them it is interpolated by eight points. The error is below 1e-6 of the peak when the durations lie 0.4 / w apart,
/// where w is the highest frequency in the prediction. A duration is computed at its first use. Any thread, several at a time.
class ProfileFamily {
 public:
  /// Fills phi at equally spaced s from 0 to 1, with inner limits at the ends. False if nothing can be predicted for that duration.
  using Sampler = std::function<bool(double duration, std::span<double> phi)>;
  struct Grid {
    std::size_t parts = 400;  // of [0, 1]
    double shortest = 0.1;    // [s] the margins around [0, 1] hold the filter's reach down to that duration
    double spacing = 0.01;    // [s] between the durations that are computed
  };
  ProfileFamily(Sampler sampler, const RecordingFilter& filter, const Grid& grid);
  /// A sampler of phi(s) that is the same for every duration.
  static Sampler sameFor(std::function<double(double s)> phiOf);

  /// phi and its change at `duration` [s]. False, and `out` unchanged, if it cannot be predicted or is shorter than the grid's shortest.
  bool at(double duration, Profile& out) const;
  /// Largest difference over s between the profile of at() and the exact profile, in parts of its peak. 1 if there is no profile.
  double errorAt(double duration) const;
  const Grid& grid() const { return grid_; }

 private:
  static constexpr int kPoints = 8;
  struct Node {
    bool possible = false;
    std::vector<double> value;
  };
  Node exactAt(double duration) const;
  const Node& node(int index) const;
  std::size_t marginAt(double duration) const;  // cells on either side of [0, 1] that the filter reaches

  Sampler sampler_;
  RecordingFilter filter_;
  Grid grid_;
  std::size_t margin_ = 0;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Node>> nodes_;               // guarded by mutex_ while it is filled
  mutable std::unique_ptr<std::atomic<const Node*>[]> published_;  // nodes that may be read without it
  int count_ = 0;
};

}  // namespace reachlab::analysis
