#include "bench/reference.h"

#include <algorithm>
#include <cmath>

#include "bench/extrapolation.h"
#include "bench/linear_reference.h"
#include "bench/visit_system.h"

namespace reachlab::bench {
namespace {

int sampleCount(const BenchScene& scene) { return static_cast<int>(std::lround(scene.duration / kSampleEvery)) + 1; }

// Coordinates and rates at t = 0. Chains on a line start at displacement 0 whatever their parameter is.
template <class System>
std::vector<Quad> initialState(const BenchScene& scene, const System&) {
  std::vector<Quad> y(2 * System::kCoordinates, Quad(0));
  if (scene.experiment.constraint.name == "line") return y;
  const int perMass = System::kCoordinates / System::kMasses;
  for (int i = 0; i < System::kCoordinates; ++i) {
    y[i] = scene.start[i % perMass];
    if (!scene.rate.empty()) y[System::kCoordinates + i] = scene.rate[i % perMass];
  }
  return y;
}

// Place and velocity in the world, of a state in the sphere's own numbers.
void appendCartesian(const BenchScene& scene, const std::vector<Quad>& y, std::vector<Quad>& states) {
  Quad world[6];
  SphereShape{scene.experiment.constraint.shape.at("R")}.placeAndVelocity(y[0], y[1], y[2], y[3], world, world + 3);
  states.insert(states.end(), world, world + 6);
}

template <class System>
Reference integrate(const BenchScene& scene, const System& system, const ReferenceSettings& settings) {
  Reference out;
  out.stateSize = scene.cartesian ? 6 : 2 * System::kCoordinates;
  out.massCount = System::kMasses, out.samples = sampleCount(scene);
  const auto rate = [&](const Quad& t, const Quad* y, Quad* dy) {
    Quad r[3], v[3];
    evaluate(scene.hand, t, r, v);
    system.rate(y, r, v, dy);
  };
  Extrapolation<Quad, decltype(rate)> integrator(rate, 2 * System::kCoordinates, settings.columns, settings.tolerance);
  std::vector<Quad> y = initialState(scene, system), r(3 * out.massCount);
  for (int k = 0; k < out.samples; ++k) {
    if (k > 0) integrator.advance(Quad(k - 1) / 100, Quad(k) / 100, y);
    system.positions(y.data(), r.data());
    if (scene.cartesian) appendCartesian(scene, y, out.states);
    else out.states.insert(out.states.end(), y.begin(), y.end());
    out.positions.insert(out.positions.end(), r.begin(), r.end());
  }
  return out;
}

// A free bead on a sphere: r = r0 cos(w t) + v0/w sin(w t) with w = |v0|/R, through the very start that the simulator is given.
Reference greatCircle(const BenchScene& scene, double radius) {
  Reference out;
  out.stateSize = 6, out.massCount = 1, out.samples = sampleCount(scene);
  Quad r0[3], v0[3];
  SphereShape{radius}.placeAndVelocity(Quad(scene.start[0]), Quad(scene.start[1]), Quad(scene.rate[0]), Quad(scene.rate[1]), r0, v0);
  const Quad w = squareRoot(dot3(v0, v0)) / radius;
  for (int k = 0; k < out.samples; ++k) {
    const Quad angle = w * k / 100;
    const auto [s, c] = sineCosine(angle);
    for (int i = 0; i < 3; ++i) out.positions.push_back(r0[i] * c + v0[i] / w * s);
    for (int i = 0; i < 3; ++i) out.states.push_back(r0[i] * c + v0[i] / w * s);
    for (int i = 0; i < 3; ++i) out.states.push_back(v0[i] * c - r0[i] * w * s);
  }
  return out;
}

double largestDifference(const std::vector<Quad>& a, const std::vector<Quad>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, static_cast<double>(absolute(Quad(a[i] - b[i]))));
  return worst;
}

}  // namespace

Reference computeReference(const BenchScene& scene) {
  if (scene.cartesian && scene.hand.kind == SceneHand::Kind::None) return greatCircle(scene, scene.experiment.constraint.shape.at("R"));
  if (scene.experiment.constraint.name != "line") return extrapolatedReference(scene);
  return scene.experiment.object.masses.size() > 10 ? modalChainReference(scene) : exponentialReference(scene);
}

Reference extrapolatedReference(const BenchScene& scene, const ReferenceSettings& settings) {
  return visitSystem(scene, [&](const auto& system) { return integrate(scene, system, settings); });
}

Deviation compare(const Reference& a, const Reference& b) {
  return {largestDifference(a.states, b.states), largestDifference(a.positions, b.positions)};
}

}  // namespace reachlab::bench
