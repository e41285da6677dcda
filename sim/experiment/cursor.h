#pragma once
#include <cstdint>
#include <optional>

namespace reachlab::experiment {

/// The part of a trial in which the subject sees the cursor.
enum class CursorShow : std::uint8_t { Always, MovementEnd, Never };
/// The point that the task's tolerances judge.
enum class CursorJudge : std::uint8_t { Cursor, Hand };

/// A cursor that is not at the hand, in the plane of the task: c = s + g R (h - s) with start s, gain g and hand h. R rotates by an angle.
/// A clamped cursor moves along one line: c = s + |h - s| R u, where u points from start to target.
struct Cursor {
  double rotation = 0;          // [degrees] counterclockwise for a viewer of the plane (task_plane.h)
  double gain = 1;              // > 0
  std::optional<double> clamp;  // [degrees] of the line from the direction to the target
  double delay = 0;             // [s] of the picture only
  CursorShow show = CursorShow::Always;
  CursorJudge judge = CursorJudge::Cursor;
  bool operator==(const Cursor&) const = default;
};

}  // namespace reachlab::experiment
