#include "gui/trial_trace.h"

namespace reachlab::gui {

bool TraceSink::onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept {
  if (state.tick % kEvery == 0 && state.massCount > 0) {
    const dynamics::MassState &first = state.masses[0], &last = state.masses[static_cast<std::size_t>(state.massCount - 1)];
    (void)points_.tryPush({state.tick, state.trial, state.phase, state.trialTime, state.hand.position, state.hand.velocity, last.r, last.v,
                           first.q[0], last.q[0], norm(state.couplingForce)});
  }
  return recorder_ == nullptr || recorder_->onTick(state, command, missedTicks);
}

void TraceSink::announce(std::int32_t trial, const trial::PlannedTrial& planned) {
  if (recorder_ != nullptr) recorder_->announce(trial, planned);
}

void TraceSink::awaitTrial(std::int32_t trial) {
  if (recorder_ != nullptr) recorder_->awaitTrial(trial);
}

void TraceSink::close() {
  if (recorder_ != nullptr) recorder_->close();
}

}  // namespace reachlab::gui
