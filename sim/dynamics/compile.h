#pragma once
#include <limits>
#include <memory>
#include <string>

#include "sim/dynamics/exact/linear_space.h"
#include "sim/dynamics/object/object_model.h"

namespace reachlab::constraints {
struct CurveRegularity;
struct SurfaceBranches;
}  // namespace reachlab::constraints

namespace reachlab::dynamics {

class Plant;
struct Quadric;

struct MethodRequest {
  std::string method;    // rk4 | abm | adaptive | stiff
  double tolerance = 0;  // 0: default
};

// The forms in which a scene can be computed, one function and one file per form. Only that file instantiates the templates behind it.

std::unique_ptr<Plant> makeExactPlant(const ObjectModel& model, const LinearSpace& space, double dt);
std::unique_ptr<Plant> makeLinePlant(const ObjectModel& model, const LinearSpace& space, const MethodRequest& request);
std::unique_ptr<Plant> makeFreePlant(const ObjectModel& model, const MethodRequest& request);
std::unique_ptr<Plant> makeBodyPlant(const ObjectModel& model, const experiment::Object& object, const MethodRequest& request);
/// Choices for the equations of a curve. `tangential` takes the speed along the curve as velocity, for curves that are hard somewhere.
struct CurveForm {
  bool tangential = false;
  double largestSpeed = 1;  // [m] |r_phi|
  double seenLo = -std::numeric_limits<double>::infinity(),
         seenHi = std::numeric_limits<double>::infinity();  // short bends are known between
};
std::unique_ptr<Plant> makeCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint, const CurveForm& form,
                                      const MethodRequest& request);
/// A curve whose formula is smooth by pieces only.
std::unique_ptr<Plant> makeBrokenCurvePlant(const ObjectModel& model, const constraints::Constraint& constraint,
                                            std::shared_ptr<const constraints::CurveRegularity> regularity, double typicalSpeed,
                                            const MethodRequest& request);
/// `branches`: null for a surface that is smooth throughout.
std::unique_ptr<Plant> makeChartPlant(const ObjectModel& model, const constraints::Constraint& constraint,
                                      std::shared_ptr<const constraints::SurfaceBranches> branches, const MethodRequest& request);
/// `edges`: some end of the domain is an edge and not a pole.
std::unique_ptr<Plant> makeQuadricPlant(const ObjectModel& model, const constraints::Constraint& constraint, const Quadric& quadric,
                                        bool edges, const MethodRequest& request);

/// The space of a straight scene: the axis of the line, or free space when `constraint` is Free.
LinearSpace linearSpace(const constraints::Constraint& constraint);

}  // namespace reachlab::dynamics
