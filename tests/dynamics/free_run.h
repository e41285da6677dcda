#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "constraints/regularity/analysis.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {

/// One mass of 1 kg, let go on a definition at a seeded place inside its domain, in a seeded direction with 0.3 m/s: no hand, no gravity, no
/// viscosity, so that it follows a geodesic and keeps its energy.
struct FreeRun {
  std::vector<double> start, rate;
  double seconds = 0;  // how far it came: 10 s, or up to an end or a place without continuation
  double drift = 0;    // largest |E/E(0) - 1| at any tick
  StepStatus status = StepStatus::Ok;
  std::string reason;  // of a stop
  MethodChoice choice;
};

inline constexpr double kFreeRunSeconds = 10, kFreeRunSpeed = 0.3;  // [s], [m/s]

/// `elastic`: every end that is none of a period throws the mass back, whatever the definition says.
inline FreeRun runFree(constraints::Definition definition, std::uint64_t seed, bool elastic) {
  if (elastic)
    for (constraints::DomainText& d : definition.domain) d.atEnd = constraints::AtEnd::Bounce;
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const constraints::Constraint constraint = constraints::makeConstraint(definition);
  const std::array<constraints::Domain, 2> domain = constraints::boundedDomain(constraint);
  FreeRun result;
  for (int k = 0; k < constraint.parameterCount(); ++k)
    result.start.push_back(domain[k].lo + (0.2 + 0.6 * uniform()) * (domain[k].hi - domain[k].lo));
  const double angle = 2 * std::numbers::pi * uniform();
  if (constraint.kind == constraints::ConstraintKind::Curve) {
    const constraints::CurvePoint p = constraints::evaluate(constraint.curve, result.start[0]);
    result.rate = {std::copysign(kFreeRunSpeed, std::cos(angle)) / norm(p.rPhi)};
  } else {
    const constraints::SurfacePoint p = constraints::evaluate(constraint.surface, result.start[0], result.start[1]);
    const double a = std::cos(angle) / norm(p.rU), b = std::sin(angle) / norm(p.rV), speed = norm(a * p.rU + b * p.rV);
    result.rate = {kFreeRunSpeed * a / speed, kFreeRunSpeed * b / speed};
  }

  experiment::Experiment experiment = from(makePoint(), result.start, definition.target);
  experiment.constraint.name = definition.name;
  experiment.constraint.definition = constraints::toJson(definition);
  Scene scene = freeScene(experiment, result.start, result.rate);
  result.choice = scene.choice;
  const double before = scene.plant->energy({});
  const int ticks = static_cast<int>(kFreeRunSeconds * 1000);
  for (int i = 0; i < ticks; ++i) {
    result.status = scene.plant->step(makeSegment(noHand, i * 1e-3, 1e-3), 1e-3);
    result.drift = std::max(result.drift, std::abs(scene.plant->energy({}) / before - 1));
    if (result.status != StepStatus::Ok) {
      result.reason = scene.plant->stopReason();
      result.seconds = (i + scene.plant->lastStepFraction()) * 1e-3;
      return result;
    }
  }
  result.seconds = kFreeRunSeconds;
  return result;
}

}  // namespace reachlab::dynamics
