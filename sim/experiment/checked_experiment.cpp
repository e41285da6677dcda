#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number_range.h"
#include "constraints/constraint.h"
#include "constraints/geometry/task_path.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment_keys.h"
#include "sim/experiment/task_plane.h"

namespace reachlab::experiment {
namespace {

void checkInertia(const Object& object, std::vector<Fault>& faults) {
  const auto& m = object.inertia;
  const std::size_t before = faults.size();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      if (!isWithin(componentRange(), m[i][j])) return;  // told with the keys
      if (i == j) checkNumber(fmt::format("object.inertia_kg_m2[{}][{}]", i, j), m[i][j], inertiaRange(), faults);
    }
  if (faults.size() > before) return;
  const double minor2 = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  const bool symmetric = m[0][1] == m[1][0] && m[0][2] == m[2][0] && m[1][2] == m[2][1];
  if (!symmetric || !(m[0][0] > 0 && minor2 > 0 && determinant > 0))
    faults.push_back({"object.inertia_kg_m2", "is not a symmetric positive matrix",
                      "an inertia tensor: [Ix, Iy, Iz] above 0 kg m^2, or a symmetric positive 3 x 3 matrix"});
}

/// Each number in its range and each name among those that there are, under its key. How many elements a list has is asked elsewhere.
struct KeyCheck {
  std::string group;
  std::vector<Fault>& faults;

  void operator()(const Key& key, double value) const { checkNumber(keyIn(group, key.name), value, key.range, faults); }
  void operator()(const Key& key, int value) const { checkNumber(keyIn(group, key.name), value, key.range, faults); }
  void operator()(const Key& key, const std::string& value) const {
    if (key.names != nullptr) checkChoice(keyIn(group, key.name), value, *key.names, faults);
  }
  void operator()(const Key& key, const std::array<double, 2>& v) const {
    checkNumbers(keyIn(group, key.name), {v[0], v[1]}, 2, key.range, faults);
  }
  void operator()(const Key& key, const Vec3& v) const { checkNumbers(keyIn(group, key.name), {v.x, v.y, v.z}, 3, key.range, faults); }
  void operator()(const Key& key, const std::vector<Vec3>& places) const {
    for (std::size_t i = 0; i < places.size(); ++i)
      checkNumbers(fmt::format("{}[{}]", keyIn(group, key.name), i), {places[i].x, places[i].y, places[i].z}, 3, key.range, faults);
  }
  template <std::size_t N>
  void operator()(const Key& key, const SquareMatrix<N>& matrix) const {
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = 0; j < N; ++j)
        checkNumber(fmt::format("{}[{}][{}]", keyIn(group, key.name), i, j), matrix[i][j], key.range, faults);
  }
  void operator()(const Key&, const ForceLaw& law) const {
    std::visit([&](const auto& of) { visitKeys(of, *this); }, law);
  }
  void operator()(const Key& key, const Environment& environment) const {
    for (std::size_t i = 0; i < environment.size(); ++i)
      visitKeys(environment[i], KeyCheck{fmt::format("{}[{}]", keyIn(group, key.name), i), faults});
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>& value) const {
    if (value) (*this)(key, *value);
  }
  template <class T>
  void operator()(const Key& key, const T& value) const {
    if constexpr (requires { visitKeys(value, *this); }) visitKeys(value, KeyCheck{keyIn(group, key.name), faults});
  }
};

void checkObject(const Object& object, std::vector<Fault>& faults) {
  if (object.kind == ObjectKind::None) {
    const bool bare = object.masses.empty() && object.stiffness.empty() && object.damping.empty();
    if (!bare) faults.push_back({"object.kind", "is none, but the object has masses or springs", "none without masses_kg and springs"});
    return;
  }
  const bool one = object.kind == ObjectKind::Point || object.kind == ObjectKind::Body;
  const std::size_t count = object.masses.size(), before = faults.size();
  if (one) checkNumbers("object.masses_kg", object.masses, 1, massRange(), faults);
  else if (count < 1 || count > kMaxMasses)
    faults.push_back({"object.masses_kg", fmt::format("has {} elements", count), fmt::format("1 to {} masses", kMaxMasses)});
  else checkNumbers("object.masses_kg", object.masses, -1, massRange(), faults);
  const bool countIsRight = faults.size() == before || (count >= 1 && faults.back().key != "object.masses_kg");
  if (countIsRight) {
    const int springs = static_cast<int>(springCount(object));
    checkNumbers("object.stiffness_n_per_m", object.stiffness, springs, stiffnessRange(), faults);
    checkNumbers("object.damping_n_s_per_m", object.damping, springs, dampingRange(), faults);
  }
  if (object.kind == ObjectKind::Body) checkInertia(object, faults);
}

void checkCoupling(const Experiment& e, std::vector<Fault>& faults) {
  const bool parallel = e.object.kind == ObjectKind::Parallel;
  if (e.object.kind == ObjectKind::None) {
    if (e.coupling) faults.push_back({"coupling", "is given, but object.kind is none and there is nothing to couple", "no coupling"});
    return;
  }
  if (parallel && e.coupling)
    return faults.push_back({"coupling", "stands beside a parallel object, whose own springs are the hand's", "no coupling"});
  if (!parallel && !e.coupling) faults.push_back({"coupling", "is missing", "{ \"stiffness_n_per_m\": …, \"damping_n_s_per_m\": … }"});
}

void checkHands(const Experiment& e, std::vector<Fault>& faults) {
  if (e.hands.size() > kMaxHands)
    return faults.push_back({"hands", fmt::format("has {} hands", e.hands.size()), fmt::format("up to {}", kMaxHands)});
  const int masses = static_cast<int>(e.object.masses.size());
  for (std::size_t i = 0; i < e.hands.size(); ++i) {
    const Hand& hand = e.hands[i];
    const std::string key = fmt::format("hands[{}]", i);
    if (hand.mass < 0 || hand.mass > masses)
      faults.push_back({key + ".mass", fmt::format("is {}", hand.mass), fmt::format("1 to {}, a mass of the object", masses)});
    const int springs = hand.mass == 0 ? masses : 1;
    checkNumbers(key + ".stiffness_n_per_m", hand.stiffness, springs, stiffnessRange(), faults);
    checkNumbers(key + ".damping_n_s_per_m", hand.damping, springs, dampingRange(), faults);
    KeyCheck{key, faults}(Key{"fp_offset_m", componentRange()}, hand.fpOffset);
    const bool holds = std::any_of(hand.stiffness.begin(), hand.stiffness.end(), [](double k) { return k > 0; });
    if (!hand.stiffness.empty() && !holds)
      faults.push_back({key + ".stiffness_n_per_m", "is 0 throughout: this hand holds nothing", "a stiffness above 0 N/m"});
  }
}

// A joint field is a quotient by the bend of the arm: it has no value where the arm is stretched or does not reach.
void checkReachOfArm(const Experiment& e, const std::string& key, const constraints::Constraint& constraint, std::vector<Fault>& faults) {
  constexpr int kProbes = 64;
  if (!e.task || e.task->start.size() != e.task->target.size()) return;
  const double least = std::abs(e.arm.length[0] - e.arm.length[1]), most = e.arm.length[0] + e.arm.length[1];
  for (int i = 0; i <= kProbes; ++i) {
    std::vector<double> q = e.task->start;
    for (std::size_t k = 0; k < q.size(); ++k) q[k] += (e.task->target[k] - q[k]) * i / kProbes;
    const Vec3 r = constraints::placeOn(constraint, q);
    if (!isFinite(r)) return;
    const double away = std::hypot(r.x - e.arm.shoulder[0], -r.z - e.arm.shoulder[1]);
    if (away > least && away < most) continue;
    const char* const where = i == 0 ? "the task's start" : i == kProbes ? "the task's target" : "the way to the target";
    return faults.push_back({key + ".kind", fmt::format("is joint-viscous, but {} is {:g} m from the arm's shoulder", where, away),
                             fmt::format("more than {:g} and less than {:g} m, where the arm is bent", least, most)});
  }
}

// Not finite where start or target has no place.
Vec3 wayOf(const Task& task, const constraints::Constraint& constraint) {
  return constraints::placeOn(constraint, task.target) - constraints::placeOn(constraint, task.start);
}

void checkEnvironment(const Experiment& e, const constraints::Constraint* constraint, std::vector<Fault>& faults) {
  constexpr std::size_t kMostForces = 100;  // a servo cycle has time for them
  if (e.environment.size() > kMostForces)
    return faults.push_back({"environment", fmt::format("has {} forces", e.environment.size()), fmt::format("up to {}", kMostForces)});
  constexpr double kOnePlace = 1e-9;  // [m] between start and target of a full lap, whose sines and cosines are rounded
  const bool stays = constraint != nullptr && e.task && norm(wayOf(*e.task, *constraint)) <= kOnePlace;
  for (std::size_t i = 0; i < e.environment.size(); ++i) {
    const std::string key = fmt::format("environment[{}]", i);
    const ForceLaw& law = e.environment[i].law;
    if (std::holds_alternative<ChannelForce>(law) && stays)
      faults.push_back(
          {key + ".kind", "is channel, but start and target are the same place", "a task with a distance from start to target"});
    if (const auto* channel = std::get_if<ChannelForce>(&law); channel != nullptr && channel->breakDistance <= channel->halfWidth)
      faults.push_back({key + ".break_m",
                        fmt::format("is {:g}, so that the channel lets go before its walls are touched", channel->breakDistance),
                        fmt::format("more than {:g} m, its half_width_m", channel->halfWidth)});
    if (constraint != nullptr && std::holds_alternative<JointViscousForce>(law)) checkReachOfArm(e, key, *constraint, faults);
    const auto* pulse = std::get_if<PulseForce>(&law);
    if (pulse == nullptr) continue;
    if (pulse->at.onset.has_value() == pulse->at.distance.has_value())
      faults.push_back({key + ".at", "needs exactly one of onset_s and distance_m", "one of the two"});
    if (pulse->duration < 2 * pulse->rise)
      faults.push_back({key + ".duration_s", fmt::format("is {:g}, shorter than rise and fall", pulse->duration),
                        fmt::format("at least {:g} s, two times rise_s", 2 * pulse->rise)});
  }
  if (!e.environment.empty() && e.hands.size() > 1)
    faults.push_back({"environment", fmt::format("is given with {} hands", e.hands.size()), "one hand"});
}

void checkCursor(const Experiment& e, const constraints::Constraint* constraint, std::vector<Fault>& faults) {
  if (!e.cursor) return;
  if (e.object.kind != ObjectKind::None)
    faults.push_back({"cursor", "is given with an object, which the subject sees where it is", "object { \"kind\": \"none\" }"});
  if (e.task && constraint != nullptr && constraint->kind == constraints::ConstraintKind::Free &&
      (e.cursor->rotation != 0 || e.cursor->clamp)) {
    constexpr double kAcross = 1e-9;  // of the way
    const Vec3 way = wayOf(*e.task, *constraint), normal = normalOf(e.task->plane);
    if (norm(way) > 0 && norm(way - dot(way, normal) * normal) <= kAcross * norm(way))
      faults.push_back({e.cursor->clamp ? "cursor.clamp_deg" : "cursor.rotation_deg",
                        "turns the cursor in the task's plane, and the way to the target is normal to it", "another task.plane"});
  }
  if (e.cursor->clamp && (e.cursor->rotation != 0 || e.cursor->gain != 1))
    faults.push_back({"cursor.clamp_deg", "is given with a rotation or a gain, and a clamped cursor has neither", "clamp_deg alone"});
}

/// `coordinates` < 0: the constraint is at fault itself, and how many there are is not known.
void checkPlaces(const Task& task, int coordinates, std::vector<Fault>& faults) {
  for (const auto& [key, place] : {std::pair{"task.start", &task.start}, std::pair{"task.target", &task.target}}) {
    if (place->empty()) faults.push_back({key, "is missing", "constraint parameters, or three metres when free"});
    else checkNumbers(key, *place, coordinates, componentRange(), faults);
  }
  constexpr std::size_t kMostVia = 20;  // a subject cannot learn a longer way
  if (task.via.size() > kMostVia)
    faults.push_back({"task.via_m", fmt::format("has {} places", task.via.size()), fmt::format("up to {}", kMostVia)});
}

void checkShape(const constraints::ConstraintSpec& spec, std::vector<Fault>& faults) {
  for (const auto& [key, value] : spec.shape) checkNumber("constraint.shape." + key, value, componentRange(), faults);
}

void checkObjectOnConstraint(const Experiment& e, const constraints::Constraint& constraint, std::vector<Fault>& faults) {
  const Object& object = e.object;
  using constraints::ConstraintKind;
  if (object.kind == ObjectKind::None && constraint.kind != ConstraintKind::Free)
    faults.push_back({"object.kind", "is none, so there is nothing that the constraint could hold", "constraint { \"name\": \"free\" }"});
  if (object.kind == ObjectKind::None && !e.hands.empty())
    faults.push_back({"hands", "are given without an object", "one hand, without the key hands"});
  if (object.kind == ObjectKind::Body && constraint.kind != ConstraintKind::Free)
    faults.push_back({"object.kind", "is body, which moves free", "constraint { \"name\": \"free\" }"});
  if (constraint.kind != ConstraintKind::Surface) return;
  if (object.masses.size() > 1)
    faults.push_back({"object.masses_kg", fmt::format("has {} masses on a surface", object.masses.size()),
                      "one mass on a surface; chains and parallel objects on curves or free"});
  if (object.kind == ObjectKind::Parallel) faults.push_back({"object.kind", "is parallel on a surface", "parallel on curves or free"});
  if (!e.hands.empty()) faults.push_back({"hands", "hold an object on a surface", "several hands on lines, curves or free"});
}

}  // namespace

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> names{"auto", "rk4", "exact", "abm", "adaptive", "stiff"};
  return names;
}

const std::vector<std::string>& velocityEstimatorNames() {
  static const std::vector<std::string> names{"auto", "difference", "low-pass", "butterworth", "kalman", "adaptive-window", "device"};
  return names;
}

const Task& requiredTask(const Experiment& experiment) {
  if (!experiment.task) throw FaultError(Fault{"task", "is missing, and a trial needs one", "{ start, target, duration_s, … }"});
  return *experiment.task;
}

std::optional<std::array<constraints::Domain, 2>> placesInUse(const std::optional<Task>& task) {
  if (!task || task->start.empty() || task->start.size() > 2 || task->start.size() != task->target.size()) return {};
  std::array<constraints::Domain, 2> range{constraints::Domain{0, 0}, constraints::Domain{0, 0}};
  for (std::size_t k = 0; k < task->start.size(); ++k) {
    const double a = task->start[k], b = task->target[k];
    if (!isWithin(anyNumber(), a) || !isWithin(anyNumber(), b)) return {};
    range[k] = {std::min(a, b), std::max(a, b)};
  }
  return range;
}

CheckedExperiment check(const Experiment& experiment, const constraints::Constraint* compiled) {
  CheckedExperiment checked;
  std::vector<Fault>& faults = checked.faults;
  checkShape(experiment.constraint, faults);
  if (compiled != nullptr) {
    checked.constraint = std::make_shared<const constraints::Constraint>(*compiled);
  } else if (faults.empty()) {
    constraints::ConstraintSpec spec = experiment.constraint;
    spec.inUse = placesInUse(experiment.task);
    try {
      checked.constraint = std::make_shared<const constraints::Constraint>(constraints::makeConstraint(spec));
    } catch (const FaultError& error) {
      faults.insert(faults.end(), error.faults.begin(), error.faults.end());
    }
  }
  visitKeys(experiment, KeyCheck{{}, faults});
  checkObject(experiment.object, faults);
  checkCoupling(experiment, faults);
  checkHands(experiment, faults);
  checkEnvironment(experiment, checked.constraint.get(), faults);
  checkCursor(experiment, checked.constraint.get(), faults);
  if (experiment.task) {
    const auto& constraint = checked.constraint;
    const bool free = constraint && constraint->kind == constraints::ConstraintKind::Free;
    checkPlaces(*experiment.task, !constraint ? -1 : free ? 3 : constraint->parameterCount(), faults);
  }
  if (checked.constraint && faults.empty()) checkObjectOnConstraint(experiment, *checked.constraint, faults);
  return checked;
}

}  // namespace reachlab::experiment
