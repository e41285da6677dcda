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

/// What one run of a scene gave. Rows are laid out as in Reference; empty unless asked for.
struct Trajectory {
  std::vector<double> states, positions;
  std::uint64_t steps = 0, rhsEvaluations = 0;
  std::uint64_t worstTick = 0;  // most right-hand sides within one millisecond
  std::string failure;          // empty: reached the end
};

/// One way to compute one scene: a method of ours, a library, or a form written for this scene alone.
struct Contender {
  std::string method;
  double step = kTickSeconds;  // [s]
  double tolerance = 0;        // 0: the method has none
  std::string form;            // what was chosen, in words
  /// Computes the whole reach from the start with a result every millisecond. `out` null: only the time matters.
  std::function<void(Trajectory* out)> run;
};

/// The hand of every step of the scene, prepared: what the haptic loop gives a plant. The same for every contender and never timed.
using Segments = std::shared_ptr<const std::vector<dynamics::HandSegment>>;
Segments makeSegments(const BenchScene& scene, double step);

/// The plant that compileScene gives for this method, driven through its public interface. Throws RefusedError as compileScene does.
Contender makePlantContender(const BenchScene& scene, const std::string& method, double step, double tolerance);

/// Keeps `value` from being optimised away.
inline void consume(double value) { asm volatile("" : : "x"(value) : "memory"); }

}  // namespace reachlab::bench
