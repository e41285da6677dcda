#include "gui/plot/live_trace.h"

#include <utility>

#include "gui/plot/signal_plot.h"
#include "gui/plot/velocity_plot.h"

namespace reachlab::gui::plot {

void LiveTrace::add(const TracePoint& p, VelocityPlot& velocity, SignalPlot& signal) {
  const std::int64_t before = std::exchange(measuredNs_, p.measuredNs);
  const double ticks = static_cast<double>(TraceSink::kEvery) + p.missed;
  const Vec3 &r = p.watched, &v = p.watchedVelocity;
  signal.add({secondsOf(p.tick),
              {r.x, r.y, r.z},
              {v.x, v.y, v.z},
              p.force,
              before > 0 ? 1e-6 * static_cast<double>(p.measuredNs - before) / ticks : 1,
              static_cast<double>(p.missed)});
  if (p.trial != trial_) {
    trial_ = p.trial;
    points_.clear();
    velocity.beginTrial();
  }
  const bool ended = p.phase == trial::Phase::Done && !points_.empty() && points_.back().phase != trial::Phase::Done;
  if (p.phase != trial::Phase::Armed && p.phase != trial::Phase::Moving && !ended) return;
  points_.push_back(p);
  if (p.phase == trial::Phase::Moving)
    velocity.add(p.trialTime, path_.velocityAlong(p.handVelocity, p.firstQ), path_.velocityAlong(p.lastVelocity, p.lastQ));
}

}  // namespace reachlab::gui::plot
