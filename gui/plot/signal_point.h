#pragma once
#include "gui/plot/signal_plot.h"
#include "gui/plot/trial_trace.h"

namespace reachlab::gui::plot {

/// `beforeNs`: time of the point before, or 0 for the first point.
inline SignalPlot::Point signalPointOf(const TracePoint& p, std::int64_t beforeNs) {
  SignalPlot::Point out;
  out.time = secondsOf(p.tick);
  out.position = {p.watched.x, p.watched.y, p.watched.z};
  out.velocity = {p.watchedVelocity.x, p.watchedVelocity.y, p.watchedVelocity.z};
  out.force = p.force;
  const double ticks = static_cast<double>(TraceSink::kEvery) + p.missed;
  out.period = beforeNs > 0 ? 1e-6 * static_cast<double>(p.measuredNs - beforeNs) / ticks : 1;
  out.missed = p.missed;
  return out;
}

}  // namespace reachlab::gui::plot
