#pragma once
#include "sim/experiment/experiment.h"

namespace reachlab::subjects {

/// One mass free in space, a short reach along another direction than an axis.
inline experiment::Experiment shortReach() {
  experiment::Experiment e = experiment::readExperiment("free-point");
  e.task->start = {-0.05, 0.02, 0.01};
  e.task->target = {0.07, 0.11, -0.03};
  e.task->duration = 0.4;
  e.task->tolerance.time = 0.1;
  e.object.viscosity = 0.6;
  return e;
}

}  // namespace reachlab::subjects
