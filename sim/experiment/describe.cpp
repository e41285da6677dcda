#include "sim/experiment/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "constraints/catalogue/definition.h"
#include "sim/experiment/experiment.h"

namespace reachlab::experiment {
namespace {

std::string numbers(const std::vector<double>& values) { return fmt::format("{:.6g}", fmt::join(values, ", ")); }

/// "0.6 kg each", or "0.6, 0.7 kg".
std::string each(const std::vector<double>& values, const char* unit) {
  const bool alike = std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
  if (values.size() == 1) return fmt::format("{:.6g} {}", values[0], unit);
  return alike && !values.empty() ? fmt::format("{:.6g} {} each", values[0], unit) : fmt::format("{} {}", numbers(values), unit);
}

std::string springs(const Object& object) {
  const bool damped = std::any_of(object.damping.begin(), object.damping.end(), [](double b) { return b != 0; });
  return "springs of " + each(object.stiffness, "N/m") + (damped ? ", dampers of " + each(object.damping, "N s/m") : "");
}

std::string objectOf(const Object& object) {
  const std::size_t n = object.masses.size();
  std::string text;
  switch (object.kind) {
    case ObjectKind::Point: text = fmt::format("one mass of {} kg", numbers(object.masses)); break;
    case ObjectKind::Chain: text = fmt::format("a chain of {} masses ({})", n, each(object.masses, "kg")); break;
    case ObjectKind::Parallel: text = fmt::format("{} parallel masses ({}), tied to the hand", n, each(object.masses, "kg")); break;
    case ObjectKind::Body: text = fmt::format("a rigid body of {} kg", numbers(object.masses)); break;
  }
  if (!object.stiffness.empty()) text += (object.kind == ObjectKind::Parallel ? " by " : " joined by ") + springs(object);
  if (object.viscosity != 0) text += fmt::format(", in a field of viscosity {:.6g} N s/m", object.viscosity);
  const Vec3& g = object.gravity;
  if (g.x != 0 || g.y != 0 || g.z != 0) text += fmt::format(", gravity ({:.6g}, {:.6g}, {:.6g}) m/s^2", g.x, g.y, g.z);
  return text;
}

std::string formula(const std::vector<std::string>& lines, bool curve) {
  return fmt::format("r({}) = ({}, {}, {}) m", curve ? "phi" : "u, v", lines[0], lines[1], lines[2]);
}

std::string withShape(const std::map<std::string, double>& shape) {
  std::string text;
  for (const auto& [name, value] : shape) text += fmt::format("{}{} = {:.6g}", text.empty() ? " with " : ", ", name, value);
  return text;
}

std::string constraintOf(const constraints::ConstraintSpec& spec) {
  if (!spec.curve.empty()) return "on " + formula(spec.curve, true) + withShape(spec.shape);
  if (!spec.surface.empty()) return "on " + formula(spec.surface, false) + withShape(spec.shape);
  if (spec.name == "free") return "free in space";
  const constraints::Definition d = spec.definition.empty() ? constraints::findDefinition(spec.name, "constraint")
                                                            : constraints::parseDefinition(spec.definition, "constraint");
  std::map<std::string, double> shape = spec.shape;
  for (const constraints::ShapeParameter& p : d.shape) shape.try_emplace(p.name, p.defaultValue);
  const auto& lines = constraints::formulaOf(d).coordinates;
  return "on " + d.name + ", " + formula({lines.begin(), lines.end()}, d.kind == constraints::ConstraintKind::Curve) + withShape(shape);
}

std::string placeOf(const std::vector<double>& q) {
  if (q.size() == 1) return "phi = " + numbers(q);
  return q.size() == 2 ? "(u, v) = (" + numbers(q) + ")" : "(" + numbers(q) + ") m";
}

std::string taskOf(const Task& task) {
  const std::string pace = describePace(task);
  return fmt::format("from rest at {} to rest at {} {}{}, every mass within {:.6g} m and {:.6g} m/s", placeOf(task.start),
                     placeOf(task.target), pace.starts_with("within") ? "" : "in ", pace, task.tolerance.position, task.tolerance.velocity);
}

}  // namespace

std::string describePace(const Task& task) {
  if (task.tolerance.time >= task.duration) return fmt::format("within {:.6g} s", task.duration + task.tolerance.time);
  return fmt::format("{:.6g} ± {:.6g} s", task.duration, task.tolerance.time);
}

std::string describe(const Experiment& e) {
  std::string text = objectOf(e.object);
  if (e.coupling) {
    text += fmt::format(", {}coupled to the hand by {:.6g} N/m", e.object.masses.size() > 1 ? "the first " : "", e.coupling->stiffness);
    if (e.coupling->damping != 0) text += fmt::format(" and {:.6g} N s/m", e.coupling->damping);
  }
  text += ", " + constraintOf(e.constraint);
  if (e.task) text += "; " + taskOf(*e.task);
  return text;
}

}  // namespace reachlab::experiment
