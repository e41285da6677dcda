#pragma once
#include <algorithm>
#include <vector>

#include "constraints/geometry/arc_curve.h"
#include "sim/dynamics/hand/hand_function.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"

namespace reachlab::predict {

struct CurveArrival {
  double position = 0, velocity = 0;  // largest error of any mass [m], [m/s]
  double along = 0;                   // largest distance of any mass from where it is predicted on the way [m]
};

/// Where the predicted hand takes the object along a line or a curve in the program's own simulator.
inline CurveArrival simulateOn(const experiment::Experiment& e, const Prediction& p, const dynamics::SceneOptions& o = {}) {
  const dynamics::Scene scene = dynamics::compileScene(e, o);
  const constraints::ArcCurve curve(*scene.constraint, e.task->start[0], e.task->target[0]);
  scene.plant->placeAtRest(e.task->start);
  const double T = p.duration;
  const dynamics::HandFunction hand = [&](double t) {
    const PredictedHand h = p.handAt(std::min(t, T));
    const auto at = curve.expand<2>(h.position);
    return dynamics::HandSample{at[0], h.velocity * at[1]};
  };
  constexpr int kSteps = 1500;
  const auto n = static_cast<size_t>(p.massCount());
  std::vector<dynamics::MassState> masses(n);
  std::vector<double> x(n), v(n);
  CurveArrival arrival;
  for (int i = 0; i < kSteps; ++i) {
    if (scene.plant->step(dynamics::makeSegment(hand, T * i / kSteps, T / kSteps), T / kSteps) != dynamics::StepStatus::Ok)
      return {1, 1, 1};
    const double t = T * (i + 1) / kSteps;
    scene.plant->observe(hand(t), masses);
    p.massesAt(t, x, v);
    for (size_t m = 0; m < n; ++m) arrival.along = std::max(arrival.along, norm(masses[m].r - curve.expand<2>(x[m])[0]));
  }
  const Vec3 target = curve.expand<2>(curve.length())[0];
  for (const dynamics::MassState& m : masses) {
    arrival.position = std::max(arrival.position, norm(m.r - target));
    arrival.velocity = std::max(arrival.velocity, norm(m.v));
  }
  return arrival;
}

}  // namespace reachlab::predict
