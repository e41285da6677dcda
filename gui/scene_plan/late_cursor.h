#pragma once
#include <cstdint>
#include <deque>

#include "base/math/vec3.h"

namespace reachlab::gui::scene {

/// The picture of a cursor that is late by a delay. The engine publishes the cursor without its delay, and a window sees it every few ticks.
class LateCursor {
 public:
  /// The cursor is at `cursor` [m] in this tick. Returns its position `delay` [s] before, between the two states that the window saw around that
  /// time. Before the first state it is where it was first seen. An earlier tick than the latest belongs to another run.
  Vec3 at(std::uint64_t tick, const Vec3& cursor, double delay);

 private:
  struct Seen {
    double time;  // [s] since the run's start
    Vec3 place;
  };
  std::deque<Seen> seen_;
};

}  // namespace reachlab::gui::scene
