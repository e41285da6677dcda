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
    case ObjectKind::None: return "the hand without an object";
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

std::string rowsOf(const auto& matrix) {
  std::string text;
  for (const auto& row : matrix) text += fmt::format("{}{:.6g}", text.empty() ? "[" : "; ", fmt::join(row, " "));
  return text + "]";
}

std::string lawOf(const HandForce& force) {
  struct {
    std::string operator()(const ViscousForce& f) const { return "a viscous field of " + rowsOf(f.matrix) + " N s/m"; }
    std::string operator()(const ElasticForce& f) const { return "an elastic field of " + rowsOf(f.matrix) + " N/m"; }
    std::string operator()(const JointViscousForce& f) const { return "a viscous field of the joints, " + rowsOf(f.matrix) + " N m s/rad"; }
    std::string operator()(const ChannelForce& f) const { return fmt::format("a channel of {:.6g} N/m", f.stiffness); }
    std::string operator()(const PulseForce& f) const {
      return fmt::format("a pulse of ({:.6g}, {:.6g}, {:.6g}) N for {:.6g} s", f.force.x, f.force.y, f.force.z, f.duration);
    }
  } words;
  return std::visit(words, force.law);
}

std::string environmentOf(const Environment& environment) {
  std::string text;
  for (const HandForce& force : environment) text += (text.empty() ? ", with " : " and ") + lawOf(force);
  return text.empty() ? text : text + " on the hand";
}

std::string cursorOf(const Cursor& cursor) {
  if (cursor.clamp) return fmt::format(", and a cursor clamped at {:.6g} degrees to the target", *cursor.clamp);
  return fmt::format(", and a cursor rotated by {:.6g} degrees with gain {:.6g}", cursor.rotation, cursor.gain);
}

std::string taskOf(const Task& task, bool object) {
  const std::string pace = describePace(task);
  const std::string via =
      task.via.empty() ? "" : fmt::format(" past {} place{} on the way", task.via.size(), task.via.size() == 1 ? "" : "s");
  return fmt::format("from rest at {} to rest at {}{} {}{}, {} within {:.6g} m and {:.6g} m/s", placeOf(task.start), placeOf(task.target),
                     via, pace.starts_with("within") ? "" : "in ", pace, object ? "every mass" : "the hand", task.tolerance.position,
                     task.tolerance.velocity);
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
  text += environmentOf(e.environment);
  if (e.cursor) text += cursorOf(*e.cursor);
  if (e.task) text += "; " + taskOf(*e.task, e.object.kind != ObjectKind::None);
  return text;
}

}  // namespace reachlab::experiment
