#include "sim/record/log/run_log.h"

namespace reachlab::record {

std::string_view nameOf(EventKind kind) {
  switch (kind) {
    case EventKind::TrialStart: return "trial_start";
    case EventKind::Armed: return "armed";
    case EventKind::Go: return "go";
    case EventKind::Onset: return "onset";
    case EventKind::TrialEnd: return "trial_end";
    case EventKind::ClampBegin: return "clamp_begin";
    case EventKind::ClampEnd: return "clamp_end";
    case EventKind::DeviceLost: return "device_lost";
    case EventKind::DeviceBack: return "device_back";
    case EventKind::TicksMissed: return "ticks_missed";
    case EventKind::StepFault: return "step_fault";
    case EventKind::Note: return "note";
    case EventKind::DeviceState: return "device_state";
    case EventKind::Intervention: return "intervention";
    case EventKind::Instrument: return "instrument";
    case EventKind::ChannelBroken: return "channel_broken";
  }
  return "unknown";
}

}  // namespace reachlab::record
