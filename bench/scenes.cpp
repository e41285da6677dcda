#include "bench/scenes.h"

#include <cmath>
#include <numbers>

#include "base/fault.h"

namespace reachlab::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kReach = 1.35;  // [s]

experiment::Task makeTask(double start, double target) {
  experiment::Task task;
  task.start = {start}, task.target = {target}, task.duration = kReach;
  return task;
}

BenchScene makeScene(std::string name, std::string title, std::string constraint, std::map<std::string, double> shape,
                     SceneHand::Kind hand) {
  BenchScene s;
  s.name = std::move(name), s.title = std::move(title);
  s.experiment.name = s.name;
  s.experiment.constraint.name = std::move(constraint), s.experiment.constraint.shape = std::move(shape);
  s.hand.kind = hand, s.hand.duration = kReach;
  return s;
}

BenchScene onLine(std::string name, std::string title, experiment::ObjectKind kind, int count, double mass, double stiffness,
                  double damping) {
  BenchScene s = makeScene(std::move(name), std::move(title), "line", {{"length_m", 0.2}}, SceneHand::Kind::Straight);
  experiment::Experiment& e = s.experiment;
  e.object.kind = kind;
  e.object.masses.assign(count, mass);
  const int springs = kind == experiment::ObjectKind::Chain ? count - 1 : count;
  e.object.stiffness.assign(springs, stiffness);
  e.object.damping.assign(springs, damping);
  if (kind != experiment::ObjectKind::Parallel) e.coupling = experiment::Coupling{600, 0};
  s.start = {0};
  e.task = makeTask(0, 2 * kPi);
  s.hand.from = {-0.1, 0, 0};
  s.hand.by = {0.2, 0, 0};
  return s;
}

void setBead(BenchScene& s, double viscosity) {
  experiment::Object& o = s.experiment.object;
  o.kind = experiment::ObjectKind::Point;
  o.masses = {1};
  o.viscosity = viscosity;
  s.experiment.coupling = experiment::Coupling{600, 5};
}

BenchScene onEllipse(std::string name, std::string title, double a, double b, double from, double viscosity) {
  BenchScene s = makeScene(std::move(name), std::move(title), "ellipse", {{"a_m", a}, {"b_m", b}}, SceneHand::Kind::Ellipse);
  setBead(s, viscosity);
  s.start = {from};
  s.experiment.task = makeTask(from, from + kPi);
  s.hand.phi0 = from, s.hand.sweep = kPi;
  s.hand.ellipse = {a, b};
  return s;
}

BenchScene nearCusp(std::string name, std::string title, double small) {
  BenchScene s = makeScene(std::move(name), std::move(title), "epitrochoid", {{"a_m", 0.08}, {"d_m", small}}, SceneHand::Kind::Epitrochoid);
  setBead(s, 0);
  s.start = {kPi / 3};
  s.experiment.task = makeTask(kPi / 3, kPi);
  s.hand.phi0 = kPi / 3, s.hand.sweep = 2 * kPi / 3;
  s.hand.epitrochoid = {0.08, small};
  return s;
}

// So that the scene is compiled where it begins.
void setStart(BenchScene& s) {
  experiment::Task task;
  task.start = task.target = s.start;
  task.duration = kReach;
  s.experiment.task = task;
}

BenchScene onSurface(std::string name, std::string title, std::string surface, std::map<std::string, double> shape, double viscosity,
                     std::vector<double> start, Vec3 from, Vec3 by) {
  BenchScene s = makeScene(std::move(name), std::move(title), std::move(surface), std::move(shape), SceneHand::Kind::Straight);
  setBead(s, viscosity);
  s.start = std::move(start);
  setStart(s);
  s.hand.from = from, s.hand.by = by;
  return s;
}

// A great circle whose nearest approach to the pole, `tilt` rad from it, comes at 0.675 s; 2 rad/s.
BenchScene pastPole(std::string name, std::string title, double tilt) {
  BenchScene s = onSurface(std::move(name), std::move(title), "", {{"R", 0.1}}, 0, {}, {}, {});
  s.experiment.constraint.surface = {"R*sin(v)*cos(u)", "R*sin(v)*sin(u)", "R*cos(v)"};  // typed, so that no name tells of the pole
  s.hand.kind = SceneHand::Kind::None;
  s.cartesian = true;
  constexpr double kSpeed = 2;  // [rad/s]
  const double angle = -kSpeed * kReach / 2;
  const Vec3 nearest{std::sin(tilt), 0, std::cos(tilt)}, along{0, 1, 0};
  const Vec3 r = std::cos(angle) * nearest + std::sin(angle) * along;
  const Vec3 v = kSpeed * (std::cos(angle) * along - std::sin(angle) * nearest);
  const double rho2 = r.x * r.x + r.y * r.y;
  s.start = {std::atan2(r.y, r.x), std::atan2(std::sqrt(rho2), r.z)};
  setStart(s);
  s.rate = {(r.x * v.y - r.y * v.x) / rho2, -v.z / std::sqrt(rho2)};
  return s;
}

// From rest, drawn over the same arc by a hand on its chord.
BenchScene pulledPastPole(std::string name, std::string title, double tilt) {
  BenchScene s = pastPole(std::move(name), std::move(title), tilt);
  s.rate.clear();
  double r[3], ru[3], rv[3], ruu[3], ruv[3], rvv[3];
  SphereShape{s.experiment.constraint.shape.at("R")}.evaluate(s.start[0], s.start[1], r, ru, rv, ruu, ruv, rvv);
  s.hand.kind = SceneHand::Kind::Straight;
  s.hand.from = {r[0], r[1], r[2]};
  s.hand.by = {0, -2 * r[1], 0};
  return s;
}

}  // namespace

std::vector<BenchScene> benchScenes() {
  std::vector<BenchScene> all;
  all.push_back(onLine("S1", "chain of 5 on a line", experiment::ObjectKind::Chain, 5, 0.6, 600, 0));
  all.push_back(onLine("S1b50", "chain of 50, 3 kg", experiment::ObjectKind::Chain, 50, 3.0 / 50, 600, 0));
  all.push_back(onLine("S1b500", "chain of 500, 3 kg", experiment::ObjectKind::Chain, 500, 3.0 / 500, 600, 0));
  all.push_back(onEllipse("S2a", "bead on an ellipse", 0.1, 0.06, 0, 0));
  all.push_back(onEllipse("S2b", "the same, viscous", 0.1, 0.06, 0, 2));

  const Vec3 outside{0.1 + 0.04 * std::cos(0.5), 0, 0.04 * std::sin(0.5)};
  all.push_back(onSurface("S3", "bead on a torus", "torus", {{"major_m", 0.1}, {"minor_m", 0.04}}, 1, {0.5, 0}, outside, {-0.12, 0.16, 0}));
  constexpr double kU = -0.95, kV = 0.3;
  const Vec3 onSaddle{0.1 * kU, 0.1 * kV, 0.05 * (kU * kU * kU - 3 * kU * kV * kV)};
  all.push_back(onSurface("S4", "bead on a monkey saddle", "monkey-saddle", {{"width_m", 0.1}, {"depth_m", 0.05}}, 1, {kU, kV}, onSaddle,
                          {0.19, -0.05, std::sqrt(0.0014)}));

  all.push_back(nearCusp("S5", "bead, 1 % from a cusp", 0.0198));
  all.push_back(nearCusp("S5h", "bead, 0.1 % from a cusp", 0.01998));

  BenchScene parallel = onLine("S6", "two masses in parallel", experiment::ObjectKind::Parallel, 2, 3, 50, 0);
  parallel.experiment.object.stiffness = {50, 250};
  parallel.experiment.task->duration = parallel.hand.duration = parallel.duration = 2.5;
  all.push_back(parallel);

  all.push_back(onLine("S7a", "stiff chain of light masses", experiment::ObjectKind::Chain, 5, 0.01, 20000, 0));
  BenchScene damped = onLine("S7b", "the same, strongly damped", experiment::ObjectKind::Chain, 5, 0.01, 20000, 50);
  damped.experiment.coupling->damping = 5;
  all.push_back(damped);
  all.push_back(onEllipse("S7c", "through the tip of a flat ellipse", 0.1, 1e-4, kPi / 4, 0));
  all.push_back(pastPole("S7d", "geodesic 1e-3 rad past a pole", 1e-3));
  all.push_back(pastPole("S7e", "geodesic 1e-6 rad past a pole", 1e-6));
  all.push_back(pulledPastPole("S7f", "bead pulled 1e-3 rad past a pole", 1e-3));

  BenchScene chain = onEllipse("S8", "chain of 5 on an ellipse", 0.1, 0.06, 0, 0);
  chain.experiment.object.kind = experiment::ObjectKind::Chain;
  chain.experiment.object.masses.assign(5, 0.6);
  chain.experiment.object.stiffness.assign(4, 600);
  chain.experiment.object.damping.assign(4, 1);
  all.push_back(chain);
  return all;
}

BenchScene benchScene(const std::string& name) {
  std::string names;
  for (BenchScene& scene : benchScenes()) {
    if (scene.name == name) return std::move(scene);
    names += (names.empty() ? "" : ", ") + scene.name;
  }
  throw FaultError(Fault{"scene", "is " + name, names + ", constraint-eval"});
}

}  // namespace reachlab::bench
