#include "gui/inspector/trial_replay.h"

#include <algorithm>
#include <cmath>

#include "base/ticks.h"

namespace reachlab::gui::inspector {

TrialReplay::TrialReplay(const analysis::RunSource& run, const record::RecordedTrial& trial) {
  const record::ChannelTable& table = run.configuration.table;
  zero_ = trial.armedTick > 0 ? trial.armedTick : trial.startTick;
  rows_ = run.rowsOf(zero_, std::max(zero_, trial.result.endTick > 0 ? trial.result.endTick : trial.lastTick));
  hand_ = table.indexOf("hand_pos_x");
  // Without an object nothing is coupled, and the hand feels the environment alone.
  force_ = table.indexOf(table.massCount == 0 && table.environment ? "environment_force_x" : "coupling_force_x");
  valid_ = table.indexOf("valid");
  // Without an object the hand, or its cursor, is drawn as a mass.
  mass_ = table.indexOf(table.massCount > 0 ? "mass1_pos_x" : table.cursor ? "cursor_pos_x" : "hand_pos_x");
  massCount_ = static_cast<std::size_t>(std::max(1, table.massCount));
  massStep_ = massCount_ > 1 ? table.indexOf("mass2_pos_x") - mass_ : 0;
  isBody_ = table.body;
  if (isBody_) body_ = table.indexOf("body_quat_w");
}

double TrialReplay::timeOf(std::size_t row) const {
  const std::uint64_t tick = rows_.ticks[row];
  return tick < zero_ ? -secondsBetween(tick, zero_) : secondsBetween(zero_, tick);
}

std::size_t TrialReplay::rowBefore(double time) const {
  std::size_t low = 0, high = rows_.size();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (timeOf(middle) <= time ? low : high) = middle;
  }
  return low;
}

double TrialReplay::neighbour(double time, int rows) const {
  if (empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(rowBefore(time + 1e-9)) + rows;
  return timeOf(static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(at, 0, static_cast<std::ptrdiff_t>(rows_.size()) - 1)));
}

scene::SceneFrame TrialReplay::frameAt(double time) const {
  scene::SceneFrame frame;
  if (empty()) return frame;
  const std::size_t a = rowBefore(time), b = std::min(a + 1, rows_.size() - 1);
  const double gap = timeOf(b) - timeOf(a), part = gap > 0 ? std::clamp((time - timeOf(a)) / gap, 0.0, 1.0) : 0;
  const auto number = [&](std::size_t column) { return (1 - part) * rows_.at(a, column) + part * rows_.at(b, column); };
  const auto vector = [&](std::size_t column) { return Vec3{number(column), number(column + 1), number(column + 2)}; };
  ownHand(frame) = vector(hand_);
  frame.handValid = rows_.at(a, valid_) != 0;
  for (std::size_t i = 0; i < massCount_; ++i) frame.masses.push_back(vector(mass_ + i * massStep_));
  if (isBody_) {
    // Between two rows it turns by little: the chord, made a unit again, is the arc.
    double length = 0, same = 0;
    for (std::size_t k = 0; k < 4; ++k) same += rows_.at(a, body_ + k) * rows_.at(b, body_ + k);
    for (std::size_t k = 0; k < 4; ++k) {
      frame.body.orientation[k] = (1 - part) * rows_.at(a, body_ + k) + (same < 0 ? -part : part) * rows_.at(b, body_ + k);
      length += frame.body.orientation[k] * frame.body.orientation[k];
    }
    for (double& q : frame.body.orientation) q /= std::sqrt(length);
  }
  return frame;
}

double TrialReplay::forceAt(double time) const {
  if (empty()) return 0;
  const std::size_t row = rowBefore(time);
  return norm(rows_.vectorAt(row, force_));
}

}  // namespace reachlab::gui::inspector
