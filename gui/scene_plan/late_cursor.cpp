#include "gui/scene_plan/late_cursor.h"

#include "base/ticks.h"

namespace reachlab::gui::scene {

Vec3 LateCursor::at(std::uint64_t tick, const Vec3& cursor, double delay) {
  const double now = secondsOf(tick), shown = now - delay;
  if (!seen_.empty() && now < seen_.back().time) seen_.clear();
  if (seen_.empty() || now > seen_.back().time) seen_.push_back({now, cursor});
  while (seen_.size() > 1 && seen_[1].time <= shown) seen_.pop_front();
  const Seen& before = seen_.front();
  if (seen_.size() == 1 || shown <= before.time) return before.place;
  const Seen& after = seen_[1];
  return before.place + (shown - before.time) / (after.time - before.time) * (after.place - before.place);
}

}  // namespace reachlab::gui::scene
