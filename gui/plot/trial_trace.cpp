#include "gui/plot/trial_trace.h"

namespace reachlab::gui::plot {

bool TraceSink::onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept {
  if (state.tick % kEvery == 0 && state.massCount > 0) {
    const dynamics::MassState &first = state.masses[0], &last = state.masses[static_cast<std::size_t>(state.massCount - 1)];
    (void)points_.tryPush({state.tick, state.trial, state.phase, state.trialTime, state.hand.position, state.hand.velocity, last.r, last.v,
                           first.q[0], last.q[0], norm(state.couplingForce)});
  }
  return true;
}

}  // namespace reachlab::gui::plot
