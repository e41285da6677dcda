#include "bench/sampled_hand.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.h"
#include "base/ticks.h"
#include "bench/measure.h"
#include "sim/dynamics/hand/hand_path.h"
#include "sim/dynamics/object/plant.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/checked_experiment.h"

namespace reachlab::bench {
namespace {

enum class Measurement { Clean, Noise, Quantised };

// The positions that a device would report at 0, 1, 2 … ms.
std::vector<Vec3> measuredPositions(const BenchScene& scene, Measurement measurement) {
  std::mt19937_64 random(20260101);
  std::normal_distribution<double> error(0, kNoise);
  std::vector<Vec3> positions;
  const int ticks = static_cast<int>(std::lround(scene.duration / kTickSeconds));
  for (int i = 0; i <= ticks; ++i) {
    Vec3 r = makeSample(scene.hand, i * kTickSeconds).position;
    if (measurement == Measurement::Noise) {
      const double x = error(random), y = error(random), z = error(random);
      r += Vec3{x, y, z};
    }
    if (measurement == Measurement::Quantised)
      r = {std::round(r.x / kQuantum) * kQuantum, std::round(r.y / kQuantum) * kQuantum, std::round(r.z / kQuantum) * kQuantum};
    positions.push_back(r);
  }
  return positions;
}

// Derivative at the newest of the polynomial through the newest `count` positions (backward differences). Before the record begins the
// hand rests.
Vec3 pathVelocity(const std::vector<Vec3>& r, int newest, int count) {
  const auto at = [&](int back) { return r[std::max(newest - back, 0)]; };
  Vec3 sum = at(0) - at(1);
  if (count >= 3) sum += 0.5 * (at(0) - 2.0 * at(1) + at(2));
  if (count >= 4) sum += (1.0 / 3) * (at(0) - 3.0 * at(1) + 3.0 * at(2) - at(3));
  return sum / kTickSeconds;
}

double positionError(const BenchScene& scene, const Reference& reference, const std::string& method, int samples, Measurement measurement) {
  dynamics::SceneOptions options;
  options.method = method;
  const dynamics::Scene compiled = dynamics::compileScene(scene.experiment, options);
  dynamics::Plant& plant = *compiled.plant;
  plant.placeAtRest(scene.start);
  const std::vector<Vec3> r = measuredPositions(scene, measurement);
  // A held sample is the one read before the step; every other path ends at the newest.
  dynamics::HandPath path(samples);
  path.push({r[0], {}, true});
  std::vector<dynamics::MassState> masses(plant.massCount());
  double worst = 0;
  for (int tick = 1; tick < static_cast<int>(r.size()); ++tick) {
    const int newest = samples == 1 ? tick - 1 : tick;
    const dynamics::HandSample hand{r[newest], pathVelocity(r, newest, samples), true};
    path.push(hand);
    if (plant.step(path.segment(), kTickSeconds) != dynamics::StepStatus::Ok) return std::numeric_limits<double>::quiet_NaN();
    if (tick % kTicksPerSample != 0) continue;
    plant.observe(hand, masses);
    const Quad* expected = &reference.positions[static_cast<std::size_t>(tick / kTicksPerSample) * masses.size() * 3];
    for (std::size_t i = 0; i < masses.size(); ++i) {
      const double got[3] = {masses[i].r.x, masses[i].r.y, masses[i].r.z};
      for (int a = 0; a < 3; ++a) worst = std::max(worst, static_cast<double>(absolute(Quad(got[a] - expected[3 * i + a]))));
    }
  }
  return worst;
}

}  // namespace

std::vector<SampledRow> measureSampledHand(const std::function<void(const std::string&)>& progress) {
  std::vector<SampledRow> rows;
  for (const char* name : {"S1", "S2a", "S3", "S6"}) {
    const BenchScene scene = benchScene(name);
    const Reference reference = computeReference(scene);
    progress(std::string("sampled hand: ") + name);
    for (const std::string& method : experiment::methodNames())
      for (int samples = 1; samples <= 4; ++samples) {
        try {
          SampledRow row{.scene = name, .method = method, .samples = samples};
          row.clean = positionError(scene, reference, method, samples, Measurement::Clean);
          row.noise = positionError(scene, reference, method, samples, Measurement::Noise);
          row.quantised = positionError(scene, reference, method, samples, Measurement::Quantised);
          rows.push_back(row);
        } catch (const Error& e) {
          if (samples == 1) progress("  " + method + " refused: " + e.what());
        }
      }
  }
  return rows;
}

std::string formatSampledHand(const std::vector<SampledRow>& rows) {
  static constexpr const char* kPath[] = {"", "held", "line", "parabola", "cubic"};
  std::string out = fmt::format("{:<6} {:<9} {:<9} {:>10} {:>12} {:>16}   position error, m\n", "scene", "method", "path", "clean",
                                "noise 10 um", "quantised 60 um");
  for (const SampledRow& row : rows)
    out += fmt::format("{:<6} {:<9} {:<9} {:>10.1e} {:>12.1e} {:>16.1e}\n", row.scene, row.method, kPath[row.samples], row.clean, row.noise,
                       row.quantised);
  return out;
}

}  // namespace reachlab::bench
