#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/systems/quadric_system.h"
#include "sim/dynamics/systems/surface_system.h"

namespace reachlab::dynamics {

std::unique_ptr<Plant> makeChartPlant(const ObjectModel& model, const constraints::Constraint& constraint,
                                      std::shared_ptr<const constraints::SurfaceBranches> branches, const MethodRequest& request) {
  SurfaceSystem system(model, constraint);
  system.branches = std::move(branches);
  system.watch = constraints::SurfaceWatch::make(constraint);
  return makePlant<SystemPlant<SurfaceSystem>>(model, system, request);
}

std::unique_ptr<Plant> makeQuadricPlant(const ObjectModel& model, const constraints::Constraint& constraint, const Quadric& quadric,
                                        bool edges, const MethodRequest& request) {
  QuadricSystem system(model, constraint, quadric);
  system.edges = edges;
  system.apex = hasApex(quadric);
  return makePlant<SystemPlant<QuadricSystem>>(model, system, request);
}

}  // namespace reachlab::dynamics
