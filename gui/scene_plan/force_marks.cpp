#include "gui/scene_plan/force_marks.h"

#include <algorithm>

#include "base/math/minimum_jerk.h"
#include "sim/environment/force_field.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/task_plane.h"

namespace reachlab::gui::scene {
namespace {

constexpr int kAlong = 6, kBeside = 2;                 // arrows from start to target, and to each side of them
constexpr double kStandingReach = 0.1, kBeyond = 0.1;  // [m] where the task has no distance; of the reach, of a channel beyond its ends
constexpr int kDashes = 24;

// The line from start to target in the plane of the task.
struct Way {
  Way(const experiment::Task& task, const Vec3& from, const Vec3& to) : start(from), reach(norm(to - from)) {
    const bool moves = reach > 0;
    along = moves ? (to - from) / reach : task.plane == experiment::TaskPlane::Frontal ? Vec3{0, 1, 0} : Vec3{0, 0, -1};
    side = experiment::rightOf(along, experiment::normalOf(task.plane));
    speed = moves ? reach * minimumJerkRate(0.5) / task.duration : 0;
    if (!moves) reach = kStandingReach;
  }
  Vec3 at(double onWay, double beside) const { return start + onWay * along + beside * side; }

  Vec3 start, along, side;
  double reach, speed;
};

// The engine's own laws, after they have grown.
std::vector<ForceArrow> fieldOf(const experiment::Environment& fields, const experiment::Experiment& e, const Way& way) {
  environment::ForceField law(fields, e.arm, way.start, way.start + way.reach * way.along);
  std::vector<ForceArrow> arrows;
  const double step = way.reach / (kAlong - 1);
  for (int i = 0; i < kAlong; ++i)
    for (int j = -kBeside; j <= kBeside; ++j) {
      const Vec3 at = way.at(i * step, j * step);
      Vec3 force;
      law.reset();
      for (int tick = 0; tick <= environment::ForceField::kRampTicks; ++tick) force = law.step({true, true, at, way.speed * way.along});
      if (isFinite(force) && norm(force) > 0) arrows.push_back({at, force});  // not where the arm of a joint field does not reach
    }
  return arrows;
}

void addChannel(const experiment::ChannelForce& law, const Way& way, const Vec3& normal, ForceMarks& marks) {
  const double first = -kBeyond * way.reach, last = (1 + kBeyond) * way.reach;
  const double wall = law.halfWidth, end = std::max(law.breakDistance, wall);
  for (const double sign : {-1.0, 1.0}) {
    const auto corner = static_cast<std::uint32_t>(marks.channel.points.size());
    for (const auto& [onWay, beside] : {std::pair{first, wall}, {last, wall}, {last, end}, {first, end}}) {
      marks.channel.points.push_back(way.at(onWay, sign * beside));
      marks.channel.normals.push_back(normal);
    }
    if (sign < 0) marks.channel.quads.push_back({corner, corner + 1, corner + 2, corner + 3});
    else marks.channel.quads.push_back({corner + 3, corner + 2, corner + 1, corner});  // counter-clockwise about the normal too
    marks.channel.parameterLines.push_back({way.at(first, sign * wall), way.at(last, sign * wall)});
    const double dash = (last - first) / (2 * kDashes - 1);
    for (int i = 0; i < kDashes; ++i)
      marks.letsGo.push_back({way.at(first + 2 * i * dash, sign * end), way.at(first + (2 * i + 1) * dash, sign * end)});
  }
  marks.stiffness = law.stiffness;
  marks.letGoDistance = law.breakDistance;
}

// Where a reach of minimum jerk is when the pulse begins.
Vec3 placeOf(const experiment::PulseInstant& at, const experiment::Task& task, const Way& way) {
  if (at.distance) return way.at(std::min(*at.distance, way.reach), 0);
  return way.at(way.reach * heldMinimumJerk(at.onset.value_or(0) / task.duration).value, 0);
}

}  // namespace

ForceMarks markForces(const experiment::Experiment& experiment, const Vec3& start, const Vec3& target) {
  ForceMarks marks;
  if (!experiment.task || experiment.environment.empty()) return marks;
  const Way way(*experiment.task, start, target);
  experiment::Environment fields;
  for (const experiment::HandForce& force : experiment.environment) {
    if (const auto* channel = std::get_if<experiment::ChannelForce>(&force.law))
      addChannel(*channel, way, experiment::normalOf(experiment.task->plane), marks);
    else if (const auto* pulse = std::get_if<experiment::PulseForce>(&force.law))
      marks.pulses.push_back({placeOf(pulse->at, *experiment.task, way), pulse->force});
    else fields.push_back(force);
    if (std::holds_alternative<experiment::ViscousForce>(force.law) || std::holds_alternative<experiment::JointViscousForce>(force.law))
      marks.speed = way.speed;
  }
  if (!fields.empty()) marks.field = fieldOf(fields, experiment, way);
  return marks;
}

double longestOf(const std::vector<ForceArrow>& arrows) {
  double longest = 0;
  for (const ForceArrow& arrow : arrows) longest = std::max(longest, norm(arrow.force));
  return longest;
}

}  // namespace reachlab::gui::scene
