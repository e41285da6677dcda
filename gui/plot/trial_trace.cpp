#include "gui/plot/trial_trace.h"

#include <algorithm>
#include <utility>

namespace reachlab::gui::plot {

bool TraceSink::onTick(const haptics::TickState& state, trial::Command, std::uint32_t missedTicks) noexcept {
  missed_ += missedTicks;
  if (state.tick % kEvery == 0 && state.massCount > 0) {
    const dynamics::MassState &first = state.masses[0], &last = state.masses[static_cast<std::size_t>(state.massCount - 1)];
    TracePoint p{state.tick, state.trial, state.phase, state.trialTime, state.hands[0].hip.position,       state.hands[0].hip.velocity,
                 last.r,     last.v,      first.q[0],  last.q[0],       norm(state.hands[0].couplingForce)};
    const int mass = std::min(watched_.load(std::memory_order_relaxed), state.massCount - 1);
    p.watched = mass < 0 ? p.hand : state.masses[static_cast<std::size_t>(mass)].r;
    p.watchedVelocity = mass < 0 ? p.handVelocity : state.masses[static_cast<std::size_t>(mass)].v;
    p.measuredNs = state.measuredNs;
    p.missed = std::exchange(missed_, 0);
    (void)points_.tryPush(p);
  }
  return true;
}

}  // namespace reachlab::gui::plot
