#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

/// The onset and offset of a movement, and the scaling of movements of unlike duration onto one another. Pure functions for any thread.
namespace reachlab::analysis {

enum class OnsetRule {
  Percent,   // of the movement's own peak speed
  Absolute,  // a speed in m/s
  Task,      // the task's own window: HIP moved more than onset_m, until every mass is inside the tolerances
};
std::string_view nameOf(OnsetRule rule);  // "percent", "absolute", "task"

struct OnsetOptions {
  OnsetRule rule = OnsetRule::Percent;
  double percent = 5;         // of peak speed
  double speed = 0.01;        // [m/s] for Absolute
  double holdSeconds = 0.04;  // [s] a crossing shorter than this is a twitch, not a movement
};

/// A movement inside a sampled signal, on the signal's own clock: sample i is at i / rate.
struct Movement {
  bool found = false;
  double onset = 0, offset = 0;  // [s] crossings, interpolated between samples
  double peak = 0;               // [unit of the signal] largest value
  double peakTime = 0;           // [s] of the largest sample, refined by the parabola through its neighbours
  double duration() const { return offset - onset; }
};

/// Onset: the last upward crossing of the threshold before the first sample above half the peak. Offset: the last downward crossing of a
/// stretch of at least `holdSeconds` above the threshold. `speed` >= 0 is sampled at `rate` [Hz]. OnsetRule::Task is not for this function:
/// use movementWithin.
Movement findMovement(std::span<const double> speed, double rate, const OnsetOptions& options);
/// The same fields for a window that is already known [s].
Movement movementWithin(std::span<const double> speed, double rate, double onset, double offset);

/// Value at `time` [s], linear between samples (time normalisation asks for no more), held beyond the ends.
double valueAt(std::span<const double> signal, double rate, double time);
/// Derivative-free cubic (Catmull-Rom) through four neighbours, linear near the ends. Used where 100 Hz must not cost accuracy.
double smoothValueAt(std::span<const double> signal, double rate, double time);

inline constexpr std::size_t kProfilePoints = 101;

/// The signal from `onset` to `offset` at 101 instants, 0 … 100 %. Values are left as they are.
std::vector<double> normaliseTime(std::span<const double> signal, double rate, double onset, double offset);
/// Time-scaled to `duration` [s]: the same path run through in another time, so velocities are multiplied by
/// (offset - onset) / duration and keep the distance. 101 instants from 0 to `duration`.
std::vector<double> scaleVelocity(std::span<const double> velocity, double rate, double onset, double offset, double duration);

}  // namespace reachlab::analysis
