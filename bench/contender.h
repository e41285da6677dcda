#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/ticks.h"
#include "bench/reference.h"
#include "bench/scenes.h"

namespace reachlab::bench {

inline constexpr int kTicksPerSample = 10;  // errors are taken at 100 Hz

/// The result of one run of a scene. The rows have the layout of Reference and are empty unless the caller asked for them.
struct Trajectory {
  std::vector<double> states, positions;
  std::uint64_t steps = 0, rhsEvaluations = 0;
  std::uint64_t worstTick = 0;  // most right-hand sides within one millisecond
  std::string failure;          // empty: reached the end
};

/// One method of computing one scene: a method of ours, a library, or a form that was written for this scene alone.
struct Contender {
  std::string method;
  double step = kTickSeconds;  // [s]
  double tolerance = 0;        // 0: the method has no tolerance
  std::string form = {};       // the chosen form of the equations
  /// Computes the whole reach from the start with a result every millisecond. `out` null: only the time matters.
  std::function<void(Trajectory* out)> run;
};

/// The hand of every step of the scene, prepared as the haptic loop gives it to a plant. It is the same for every contender and is never
/// timed.
using Segments = std::shared_ptr<const std::vector<dynamics::HandSegment>>;
Segments makeSegments(const BenchScene& scene, double step);

/// The plant that compileScene gives for this method, driven through its public interface. Throws RefusedError as compileScene does.
Contender makePlantContender(const BenchScene& scene, const std::string& method, double step, double tolerance);

/// Keeps `value` from being optimised away.
inline void consume(double value) { asm volatile("" : : "x"(value) : "memory"); }

}  // namespace reachlab::bench
