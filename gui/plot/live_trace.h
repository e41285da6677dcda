#pragma once
#include <vector>

#include "gui/plot/trial_errors.h"

namespace reachlab::gui::plot {

class SignalPlot;
class VelocityPlot;

/// The trial under way as the window has it: its points, kept until the next trial, and its curves on the plots.
class LiveTrace {
 public:
  /// Velocities count along this path from now on.
  void setPath(const constraints::TaskPath& path) { path_ = path; }
  const constraints::TaskPath& path() const { return path_; }
  /// A new run numbers its trials from 1 again.
  void beginRun() { trial_ = 0, measuredNs_ = 0; }
  /// One more point: a new trial begins with its first.
  void add(const TracePoint& point, VelocityPlot& velocity, SignalPlot& signal);
  /// From the start position to the first point after the end, for the trial under way or the last trial.
  const std::vector<TracePoint>& points() const { return points_; }

 private:
  constraints::TaskPath path_;
  std::vector<TracePoint> points_;
  std::int32_t trial_ = 0;
  std::int64_t measuredNs_ = 0;  // of the last point of the run; 0: there is none
};

}  // namespace reachlab::gui::plot
