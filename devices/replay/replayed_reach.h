#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/replay/recorded_reach.h"
#include "sim/subjects/plans/played_hand.h"

namespace reachlab::devices {

/// The reach laid onto start -> target. Its chord runs from the first sample to the farthest sample from it. The chord is moved, turned by
/// the smallest rotation and scaled uniformly. Time is not scaled. The hand rests at the start for 0.3 s and joins the recorded path by a
/// minimum-jerk blend over 0.1 s. Then it follows a cubic spline (C2, natural ends) through the samples and rests at the last sample. The
/// velocity is estimated, as for any device without velocity. Throws FaultError for fewer than two samples, more than 600 s, or no
/// movement.
subjects::PlayedReach layOnto(const RecordedReach& reach, const Vec3& start, const Vec3& target);

/// A device that plays the reaches of a source (reach_source.h), one per trial. After the last reach it begins again with the first.
std::unique_ptr<haptics::HapticDevice> makeReplayHand(const std::string& argument, const Vec3& start, const Vec3& target);

}  // namespace reachlab::devices
