#include "sim/dynamics/object/hand_springs.h"

#include <algorithm>

#include "sim/experiment/experiment.h"

namespace reachlab::dynamics {

std::vector<HandSprings> handSpringsOf(const experiment::Experiment& experiment) {
  const experiment::Object& object = experiment.object;
  const std::size_t count = object.masses.size();
  const auto onOne = [&](int mass, double stiffness, double damping, const Vec3& offset) {
    HandSprings hand{std::vector<double>(count), std::vector<double>(count), offset};
    hand.stiffness.at(static_cast<std::size_t>(mass - 1)) = stiffness;
    hand.damping.at(static_cast<std::size_t>(mass - 1)) = damping;
    return hand;
  };
  std::vector<HandSprings> hands;
  for (const experiment::Hand& hand : experiment.hands)
    hands.push_back(hand.mass > 0 ? onOne(hand.mass, hand.stiffness.at(0), hand.damping.at(0), hand.fpOffset)
                                  : HandSprings{hand.stiffness, hand.damping, hand.fpOffset});
  if (!hands.empty()) return hands;
  if (object.kind == experiment::ObjectKind::Parallel) return {{object.stiffness, object.damping, {}}};
  const experiment::Coupling coupling = experiment.coupling.value_or(experiment::Coupling{});
  return {onOne(1, coupling.stiffness, coupling.damping, object.fpOffset)};
}

}  // namespace reachlab::dynamics
