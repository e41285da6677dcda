#pragma once
#include <algorithm>

#include "base/ticks.h"
#include "bench/contender.h"
#include "bench/visit_system.h"

namespace reachlab::bench {

/// A hand-written right-hand side with its hand. Only the axes and the degree that the scene uses are evaluated. Time counts from the start
/// of the current tick.
template <class System>
struct PeerSystem {
  static constexpr int kStates = 2 * System::kCoordinates;
  System system;
  const dynamics::HandSegment* segment = nullptr;
  std::uint64_t evaluations = 0;

  void rate(const double* y, double* dy, double t) {
    ++evaluations;
    double r[3] = {}, v[3] = {};
    const double s = t * (1 / kTickSeconds);
    evaluateAxes(segment->position, s, r);
    if (system.handVelocity()) evaluateAxes(segment->velocity, s, v);
    system.rate(y, r, v, dy);
  }

 private:
  static void evaluateAxes(const dynamics::HandSegment::Coefficients& c, double s, double* to) {
    constexpr unsigned axes = System::kHandAxes;
    if constexpr (axes & 1) to[0] = horner(c, &Vec3::x, s);
    if constexpr (axes & 2) to[1] = horner(c, &Vec3::y, s);
    if constexpr (axes & 4) to[2] = horner(c, &Vec3::z, s);
  }
  static double horner(const dynamics::HandSegment::Coefficients& c, double Vec3::*axis, double s) {
    constexpr int kDegree = System::kHandDegree;
    double sum = c[kDegree].*axis;
    for (int k = kDegree - 1; k >= 0; --k) sum = c[k].*axis + s * sum;
    return sum;
  }
};

/// The initial numbers of the scene, in the coordinates of the right-hand side. Chains on a line start at displacement 0, whatever their
/// parameter is.
template <class System, class T>
void setInitialState(const BenchScene& scene, T* y) {
  constexpr int n = System::kCoordinates, perMass = n / System::kMasses;
  const bool line = scene.experiment.constraint.name == "line";
  for (int i = 0; i < n; ++i) {
    y[i] = line ? 0 : scene.start[i % perMass];
    y[n + i] = scene.rate.empty() ? 0 : scene.rate[i % perMass];
  }
}

/// Appends the state and the positions. Past a pole the state is position and velocity in the world.
template <class System, class T, class Rows>
void appendSample(const System& system, const T* y, Rows& out) {
  std::vector<T> r(3 * System::kMasses);
  system.positions(y, r.data());
  if constexpr (requires { system.shape.radius; }) {
    T world[6];
    system.shape.placeAndVelocity(y[0], y[1], y[2], y[3], world, world + 3);
    out.states.insert(out.states.end(), world, world + 6);
  } else {
    out.states.insert(out.states.end(), y, y + 2 * System::kCoordinates);
  }
  out.positions.insert(out.positions.end(), r.begin(), r.end());
}

/// Drives `tick(segment index)` through a reach and takes samples. `tick` returns false when it gave up. `y` points to the state.
template <class System, class Tick>
void runReach(PeerSystem<System>& peer, const std::vector<dynamics::HandSegment>& segments, const double* y, Trajectory* out, Tick tick) {
  peer.evaluations = 0;
  if (out) appendSample(peer.system, y, *out);
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    peer.segment = &segments[i];
    if (!tick()) {
      if (out) out->failure = "gave up at " + std::to_string(static_cast<double>(i) * kTickSeconds) + " s";
      return;
    }
    if (!out) continue;
    out->worstTick = std::max(out->worstTick, peer.evaluations - before);
    before = peer.evaluations;
    if ((i + 1) % kTicksPerSample == 0) appendSample(peer.system, y, *out);
  }
  if (out) out->rhsEvaluations = peer.evaluations;
  consume(y[0]);
}

}  // namespace reachlab::bench
