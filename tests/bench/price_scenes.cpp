#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "bench/contender.h"
#include "constraints/constraint.h"
#include "sim/dynamics/exact/linear_plant.h"
#include "sim/dynamics/exact/oscillator_core.h"
#include "sim/dynamics/make_plant.h"
#include "sim/dynamics/methods/cusp_adaptive.h"
#include "sim/dynamics/systems/batch_system.h"
#include "sim/dynamics/systems/curve_system.h"

/// Times scenes on lines and curves with the plants that `auto` takes, REPEATS times each: a line `scene ns` with the least time of a millisecond.
/// tests/bench/write_prices.py compiles this file with different flags. It names the plants itself, so that few files have to be compiled.
namespace {
using namespace reachlab;
using namespace reachlab::dynamics;

std::unique_ptr<Plant> makePlantOf(const bench::BenchScene& scene) {
  const ObjectModel model = makeObjectModel(scene.experiment);
  const constraints::Constraint constraint = constraints::makeConstraint(scene.experiment.constraint);
  if (constraint.straight) {
    const LinearSpace space = linearSpace(constraint);
    if (model.kind == experiment::ObjectKind::Parallel || canBeModal(model))
      return std::make_unique<LinearPlant<OscillatorCore, 1>>(model, space, 1e-3);
    return std::make_unique<LinearPlant<DenseCore<5>, 1>>(model, space, 1e-3);
  }
  double speed = 0;  // [m] the largest |r_phi|
  for (int k = 0; k < 64; ++k) speed = std::max(speed, norm(constraints::evaluate(constraint.curve, k * 2 * std::numbers::pi / 64).rPhi));
  using Chain = SystemPlant<BatchSystem<1, false>>;
  using Bead = SystemPlant<CurveSystem<1, false>>;
  using Hard = SystemPlant<CurveSystem<1, true>>;
  const MethodRequest abm{"abm", 0};
  if (model.count() > 1) return makeExplicitPlant<Chain>(model, {model, constraint, speed}, abm);
  if (scene.name == "S2a") return makeExplicitPlant<Bead>(model, {model, constraint, speed}, abm);
  return makeExplicitPlant<Hard, CuspAdaptive>(model, {model, constraint, speed}, abm);
}
}  // namespace

int main(int count, char** words) {
  const int repeats = count > 1 ? std::atoi(words[1]) : 100;
  for (const char* name : {"S1", "S1b50", "S1b500", "S2a", "S5", "S5h", "S6", "S7b", "S7c", "S8"}) {
    const bench::BenchScene scene = bench::benchScene(name);
    const bench::Segments segments = bench::makeSegments(scene, 1e-3);
    const std::unique_ptr<Plant> plant = makePlantOf(scene);
    double best = 1e300;
    for (int i = 0; i <= repeats; ++i) {
      const auto begin = std::chrono::steady_clock::now();
      plant->placeAtRest(scene.start);
      for (const HandSegment& segment : *segments)
        if (plant->step(segment, 1e-3) != StepStatus::Ok) return 1;
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
      if (i > 0) best = std::min(best, took.count());
    }
    std::printf("%s %.6g\n", name, best / scene.duration * 1e6);
  }
}
