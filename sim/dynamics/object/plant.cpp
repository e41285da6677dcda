#include "sim/dynamics/object/plant_base.h"

namespace reachlab::dynamics {

// Here and not in every plant's own code.
PlantBase::PlantBase(const ObjectModel& model) : model_(model), located_(static_cast<std::size_t>(model.count())) {}
PlantBase::~PlantBase() = default;

std::string_view describe(StepStatus status) {
  switch (status) {
    case StepStatus::Ok: return "ok";
    case StepStatus::HandLost: return "hand lost";
    case StepStatus::NotFinite: return "not finite";
    case StepStatus::Capped: return "too many sub-steps";
    case StepStatus::AtEnd: return "end of the constraint";
    case StepStatus::NoContinuation: return "no continuation";
    case StepStatus::PeerLost: return "peer lost";
  }
  return "";
}

}  // namespace reachlab::dynamics
