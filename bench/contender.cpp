#include <cmath>

#include "base/ticks.h"
#include "bench/contender.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"

namespace reachlab::bench {
namespace {

void takeSample(const BenchScene& scene, const dynamics::Plant& plant, const dynamics::HandSample& hand, Trajectory& out) {
  std::vector<dynamics::MassState> masses(plant.massCount());
  plant.observe(hand, masses);
  const bool line = scene.experiment.constraint.name == "line";
  const int perMass = line || scene.cartesian ? 1 : static_cast<int>(scene.start.size());
  for (const bool rates : {false, true})
    for (const dynamics::MassState& m : masses) {
      const Vec3& cartesian = rates ? m.v : m.r;
      if (scene.cartesian) out.states.insert(out.states.end(), {cartesian.x, cartesian.y, cartesian.z});
      else if (line) out.states.push_back(rates ? m.v.x : m.r.x - scene.hand.from.x);
      else out.states.insert(out.states.end(), (rates ? m.qRate : m.q).begin(), (rates ? m.qRate : m.q).begin() + perMass);
    }
  for (const dynamics::MassState& m : masses) out.positions.insert(out.positions.end(), {m.r.x, m.r.y, m.r.z});
}

struct PlantRun {
  BenchScene scene;
  dynamics::Scene compiled;
  Segments segments;
  double step;
  int stepsPerTick;

  void operator()(Trajectory* out) {
    dynamics::Plant& plant = *compiled.plant;
    plant.setCoupled(scene.hand.kind != SceneHand::Kind::None);
    if (scene.rate.empty()) plant.placeAtRest(scene.start);
    else plant.place(scene.start, scene.rate);
    if (out) {
      runSampled(plant, *out);
      return;
    }
    dynamics::StepStatus status = dynamics::StepStatus::Ok;
    for (const dynamics::HandSegment& segment : *segments) {
      status = plant.step(segment, step);
      if (status != dynamics::StepStatus::Ok) break;
    }
    consume(static_cast<double>(static_cast<int>(status)));
  }

  void runSampled(dynamics::Plant& plant, Trajectory& out) {
    const std::uint64_t before = plant.rhsEvaluations();
    takeSample(scene, plant, makeSample(scene.hand, 0), out);
    std::uint64_t tickStart = before;
    for (std::size_t i = 0; i < segments->size(); ++i) {
      const dynamics::StepStatus status = plant.step((*segments)[i], step);
      if (status != dynamics::StepStatus::Ok) {
        out.failure = std::string(dynamics::describe(status)) + " at " + std::to_string(static_cast<double>(i) * step) + " s";
        return;
      }
      ++out.steps;
      if ((i + 1) % stepsPerTick == 0) {
        const std::uint64_t now = plant.rhsEvaluations();
        out.worstTick = std::max(out.worstTick, now - tickStart);
        tickStart = now;
      }
      if ((i + 1) % (stepsPerTick * kTicksPerSample) == 0) takeSample(scene, plant, dynamics::endOf((*segments)[i]), out);
    }
    out.rhsEvaluations = plant.rhsEvaluations() - before;
  }
};

}  // namespace

Segments makeSegments(const BenchScene& scene, double step) {
  const int count = static_cast<int>(std::lround(scene.duration / step));
  auto segments = std::make_shared<std::vector<dynamics::HandSegment>>();
  segments->reserve(count);
  for (int i = 0; i < count; ++i) segments->push_back(makeSegment(scene.hand, i * step, step));
  return segments;
}

Contender makePlantContender(const BenchScene& scene, const std::string& method, double step, double tolerance) {
  dynamics::SceneOptions options;
  options.method = method, options.step = step, options.tolerance = tolerance;
  auto run = std::make_shared<PlantRun>(PlantRun{scene, dynamics::compileScene(scene.experiment, options), makeSegments(scene, step), step,
                                                 static_cast<int>(std::lround(kTickSeconds / step))});
  Contender out;
  out.method = method, out.step = step, out.tolerance = tolerance;
  const dynamics::MethodChoice& choice = run->compiled.choice;
  out.form = (method == "auto" ? choice.method + ", " : "") + choice.form;
  out.run = [run](Trajectory* trajectory) { (*run)(trajectory); };
  return out;
}

}  // namespace reachlab::bench
