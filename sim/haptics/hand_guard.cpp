#include "sim/haptics/hand_guard.h"

#include <algorithm>

#include "base/ticks.h"

namespace reachlab::haptics {

std::string_view nameOf(DeviceState state) {
  constexpr std::string_view kNames[]{"off", "homed", "armed", "engaged", "fault"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(DeviceState::Fault) + 1);
  return kNames[static_cast<std::size_t>(state)];
}

std::string_view intervention::nameOf(int bit) {
  constexpr std::string_view names[kCount] = {"limit", "heat", "ramp", "slew", "wall", "passivity", "not_finite", "held_back"};
  return bit >= 0 && bit < kCount ? names[bit] : std::string_view("unknown");
}

Vec3 wallForce(const GuardSettings& settings, const Vec3& place, const Vec3& velocity) noexcept {
  if (!(settings.wallRadius > 0)) return {};
  const Vec3 away = place - settings.wallCentre;
  const double distance = norm(away);
  if (!(distance > settings.wallRadius)) return {};
  const Vec3 outwards = away / distance;
  const double push =
      settings.wallStiffness * (distance - settings.wallRadius) + settings.wallDamping * std::max(dot(velocity, outwards), 0.0);
  return -push * outwards;
}

void PassivityObserver::observe(const Vec3& place) noexcept {
  if (seen_) energy_ -= dot(force_, place - place_);
  place_ = place;
  seen_ = true;
}

Vec3 PassivityObserver::control(const Vec3& velocity) const noexcept {
  constexpr double kRest = 1e-3;  // [m/s] a hand at rest takes no energy
  const double square = dot(velocity, velocity);
  if (!(energy_ < 0) || !(square > kRest * kRest)) return {};
  return -std::min(-energy_ / (kTickSeconds * square), kMaxDissipation) * velocity;
}

}  // namespace reachlab::haptics
