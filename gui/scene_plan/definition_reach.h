#pragma once
#include "constraints/catalogue/definition.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::scene {

/// The coupling that the window gives to an object that had none.
inline constexpr experiment::Coupling kNewCoupling{600, 0};

/// The experiment of a definition's picture: one mass from its start to its target.
inline experiment::Experiment reachOn(const constraints::Definition& definition) {
  experiment::Experiment e;
  e.object.kind = experiment::ObjectKind::Point;
  e.object.masses = {1};
  e.coupling = kNewCoupling;
  e.task = experiment::Task{};
  e.task->start = definition.start;
  e.task->target = definition.target;
  return e;
}

}  // namespace reachlab::gui::scene
