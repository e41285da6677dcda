#include "sim/experiment/equality.h"

#include <algorithm>
#include <tuple>

// Every member is named: whoever adds one to a struct and not here is told by the compiler.
namespace reachlab::experiment {
namespace {

auto parts(const Coupling& c) {
  const auto& [stiffness, damping] = c;
  return std::tie(stiffness, damping);
}

auto parts(const Object& o) {
  const auto& [kind, masses, stiffness, damping, viscosity, gravity, inertia, fpOffset] = o;
  return std::tie(kind, masses, stiffness, damping, viscosity, gravity, inertia, fpOffset);
}

auto parts(const Hand& h) {
  const auto& [mass, stiffness, damping, fpOffset] = h;
  return std::tie(mass, stiffness, damping, fpOffset);
}

auto parts(const Tolerance& t) {
  const auto& [position, velocity, time] = t;
  return std::tie(position, velocity, time);
}

auto parts(const Task& t) {
  const auto& [start, target, duration, tolerance, onset, armRadius, timeout, rest] = t;
  return std::tuple_cat(std::tie(start, target, duration, onset, armRadius, timeout, rest.seconds, rest.speed), parts(tolerance));
}

auto parts(const Arm& a) {
  const auto& [length, centre, mass, inertia, damping, shoulder, elbowLeft] = a;
  return std::tie(length, centre, mass, inertia, damping, shoulder, elbowLeft);
}

auto parts(const TimingLimits& t) {
  const auto& [maxMissedTicks, maxGap] = t;
  return std::tie(maxMissedTicks, maxGap);
}

auto parts(const VelocityEstimatorSpec& v) {
  const auto& [kind, cutoff] = v;
  return std::tie(kind, cutoff);
}

auto parts(const constraints::Domain& d) {
  const auto& [lo, hi, periodic, atEnd] = d;
  return std::tie(lo, hi, periodic, atEnd);
}

auto parts(const std::array<constraints::Domain, 2>& d) { return std::tuple_cat(parts(d[0]), parts(d[1])); }

template <class T>
bool same(const T& a, const T& b) {
  return parts(a) == parts(b);
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& one, const T& other) { return same(one, other); });
}

template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

}  // namespace

bool isSameConstraint(const constraints::ConstraintSpec& a, const constraints::ConstraintSpec& b) {
  const auto& [name, curve, surface, shape, inUse, definition] = a;
  return name == b.name && curve == b.curve && surface == b.surface && shape == b.shape && same(inUse, b.inUse) &&
         definition == b.definition;
}

bool operator==(const Experiment& a, const Experiment& b) {
  const auto& [schemaVersion, name, constraint, object, coupling, hands, task, method, handMass, forceLimit, forceLimitEndsTrial, timing,
               velocityEstimator, arm, subjectScreen, text] = a;
  return schemaVersion == b.schemaVersion && name == b.name && isSameConstraint(constraint, b.constraint) && same(object, b.object) &&
         same(coupling, b.coupling) && same(hands, b.hands) && same(task, b.task) && method == b.method && handMass == b.handMass &&
         forceLimit == b.forceLimit && forceLimitEndsTrial == b.forceLimitEndsTrial && same(timing, b.timing) &&
         same(velocityEstimator, b.velocityEstimator) && same(arm, b.arm) && subjectScreen == b.subjectScreen && text == b.text;
}

}  // namespace reachlab::experiment
