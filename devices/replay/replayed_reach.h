#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/replay/recorded_reach.h"
#include "devices/simulated/played_hand.h"

namespace reachlab::devices {

/// The reach laid onto start -> target: its chord, from the first sample to the one farthest from it, is moved, turned by the smallest
/// rotation and scaled uniformly; time is not scaled. The hand rests at the start for 0.3 s, joins the recorded path by a minimum-jerk
/// blend over 0.1 s, follows a cubic spline (C2, natural ends) through the samples, and holds the last one. Velocity is left to the
/// estimator, as with any device that has none. Throws FaultError for fewer than two samples, more than 600 s, or no movement.
PlayedReach layOnto(const RecordedReach& reach, const Vec3& start, const Vec3& target);

/// A device that plays the reaches of a source (reach_source.h), one a trial, again from the first.
std::unique_ptr<haptics::HapticDevice> makeReplayHand(const std::string& argument, const Vec3& start, const Vec3& target);

}  // namespace reachlab::devices
