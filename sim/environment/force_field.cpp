#include "sim/environment/force_field.h"

#include <algorithm>
#include <cmath>

#include "base/math/elementary.h"
#include "base/ticks.h"

namespace reachlab::environment {
namespace {

std::int64_t wholeTicks(double seconds) noexcept { return std::llround(seconds / kTickSeconds); }

double share(std::int64_t age, std::int64_t ticks) noexcept { return std::min(1.0, static_cast<double>(age) / static_cast<double>(ticks)); }

Vec3 directionOf(const Vec3& v) noexcept {
  const double length = norm(v);
  return length > 0 ? v / length : Vec3{};
}

// The plane of the arm has the world's x to the right and -z forward; the arm's `shoulder` is counted in these.
Vec3 jointForce(const experiment::JointViscousForce& law, const experiment::Arm& arm, const HandTick& hand) noexcept {
  const auto angles = absoluteAngles(arm, hand.position.x - arm.shoulder[0], -hand.position.z - arm.shoulder[1]);
  const experiment::SquareMatrix<2> j = absoluteJacobian(arm, angles);
  const double determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  const double vx = hand.velocity.x, vy = -hand.velocity.z;
  const double rate0 = (j[1][1] * vx - j[0][1] * vy) / determinant, rate1 = (j[0][0] * vy - j[1][0] * vx) / determinant;
  const double torque0 = law.matrix[0][0] * rate0 + law.matrix[0][1] * rate1, torque1 = law.matrix[1][0] * rate0 + law.matrix[1][1] * rate1;
  const double right = (j[1][1] * torque0 - j[1][0] * torque1) / determinant;
  const double forward = (j[0][0] * torque1 - j[0][1] * torque0) / determinant;
  return {right, 0, -forward};
}

}  // namespace

Vec3 across(const Vec3& v, const Vec3& along) noexcept { return v - dot(v, along) * along; }

std::array<double, 2> absoluteAngles(const experiment::Arm& arm, double right, double forward) noexcept {
  const double upper = arm.length[0], lower = arm.length[1];
  const double cosine = (right * right + forward * forward - upper * upper - lower * lower) / (2 * upper * lower);
  const double bend = arm.elbowLeft ? -elementary::acos(cosine) : elementary::acos(cosine);
  const double shoulder =
      elementary::atan2(forward, right) - elementary::atan2(lower * elementary::sin(bend), upper + lower * elementary::cos(bend));
  return {shoulder, shoulder + bend};
}

experiment::SquareMatrix<2> absoluteJacobian(const experiment::Arm& arm, const std::array<double, 2>& angles) noexcept {
  return {{{-arm.length[0] * elementary::sin(angles[0]), -arm.length[1] * elementary::sin(angles[1])},
           {arm.length[0] * elementary::cos(angles[0]), arm.length[1] * elementary::cos(angles[1])}}};
}

ForceField::ForceField(const experiment::Environment& environment, const experiment::Arm& arm, const Vec3& start, const Vec3& target)
    : arm_(arm), start_(start), along_(directionOf(target - start)) {
  for (const experiment::HandForce& force : environment) forces_.push_back({.force = force});
}

void ForceField::reset() noexcept {
  channelBroken_ = false;
  for (Running& running : forces_) running.age = running.letGoAge = running.moved = -1;
}

Vec3 ForceField::step(const HandTick& hand) noexcept {
  Vec3 sum;
  for (Running& running : forces_) sum += exert(running, hand);
  return sum;
}

Vec3 ForceField::exert(Running& running, const HandTick& hand) noexcept {
  if (!hand.engaged) return {};
  if (const auto* law = std::get_if<experiment::PulseForce>(&running.force.law)) return pulse(*law, running, hand);
  if (running.age < 0 && running.force.when == experiment::ForceWhen::Movement && !hand.moving) return {};
  ++running.age;
  if (const auto* law = std::get_if<experiment::ChannelForce>(&running.force.law)) return channel(*law, running, hand);
  const double grown = share(running.age, kRampTicks);
  if (const auto* law = std::get_if<experiment::ViscousForce>(&running.force.law))
    return grown * experiment::times(law->matrix, hand.velocity);
  if (const auto* law = std::get_if<experiment::ElasticForce>(&running.force.law))
    return -grown * experiment::times(law->matrix, hand.position - law->centre.value_or(start_));
  return grown * jointForce(*std::get_if<experiment::JointViscousForce>(&running.force.law), arm_, hand);
}

Vec3 ForceField::channel(const experiment::ChannelForce& law, Running& running, const HandTick& hand) noexcept {
  const Vec3 off = across(hand.position - start_, along_), rate = across(hand.velocity, along_);
  const double distance = norm(off);
  if (distance > law.breakDistance) channelBroken_ = true;
  if (running.letGoAge >= 0 || distance > law.breakDistance) ++running.letGoAge;
  double grown = share(running.age, std::max<std::int64_t>(kRampTicks, wholeTicks(law.ramp)));
  if (running.letGoAge >= 0) grown *= 1 - share(running.letGoAge, kRampTicks);
  const double depth = distance - law.halfWidth;
  if (depth < 0 || grown == 0) return {};
  const Vec3 away = distance > 0 ? off / distance : directionOf(rate);  // on the line the damper acts as just beside it
  return -grown * (law.stiffness * depth + law.damping * dot(rate, away)) * away;
}

Vec3 ForceField::pulse(const experiment::PulseForce& law, Running& running, const HandTick& hand) noexcept {
  if (!hand.moving) return {};
  ++running.moved;
  const bool due = law.at.onset ? running.moved >= wholeTicks(*law.at.onset) : norm(hand.position - start_) >= law.at.distance.value_or(0);
  if (running.age < 0 && !due) return {};
  const std::int64_t age = ++running.age, duration = wholeTicks(law.duration), rise = std::max<std::int64_t>(1, wholeTicks(law.rise));
  if (age >= duration) return {};
  return std::min(share(age, rise), share(duration - age, rise)) * law.force;
}

}  // namespace reachlab::environment
