#include "gui/plot/live_trace.h"

#include "gui/plot/velocity_plot.h"

namespace reachlab::gui::plot {

void LiveTrace::add(const TracePoint& p, VelocityPlot& plot) {
  if (p.trial != trial_) {
    trial_ = p.trial;
    points_.clear();
    plot.beginTrial();
  }
  const bool ended = p.phase == trial::Phase::Done && !points_.empty() && points_.back().phase != trial::Phase::Done;
  if (p.phase != trial::Phase::Armed && p.phase != trial::Phase::Moving && !ended) return;
  points_.push_back(p);
  if (p.phase == trial::Phase::Moving)
    plot.add(p.trialTime, path_.velocityAlong(p.handVelocity, p.firstQ), path_.velocityAlong(p.lastVelocity, p.lastQ));
}

}  // namespace reachlab::gui::plot
