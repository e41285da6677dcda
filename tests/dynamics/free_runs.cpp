// Prints the tables of docs/benchmarks/energy-drift.md: one seeded free run on every definition of the catalogue, `free_runs [SEED]`; an hour of
// undamped scenes with every method, `free_runs hour`; what their drift comes from, `free_runs causes`.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/experiment/experiment.h"
#include "tests/dynamics/free_run.h"
#include "tests/dynamics/held_segment.h"

namespace reachlab::dynamics {
namespace {

std::string outcome(const FreeRun& run) {
  if (run.status == StepStatus::Ok) return fmt::format("10 | {:.1e}", run.drift);
  const char* why = run.status == StepStatus::AtEnd            ? "end"
                    : run.status == StepStatus::NoContinuation ? "degenerate"
                                                               : describe(run.status).data();
  return fmt::format("{:.3f} {} | {:.1e}", run.seconds, why, run.drift);
}

void printTable(std::uint64_t seed) {
  fmt::print("| definition | from | rate [1/s] | as shipped [s] | drift | elastic ends [s] | drift |\n|---|---|---|---|---|---|---|\n");
  for (const constraints::Definition& definition : constraints::catalogue()) {
    const FreeRun shipped = runFree(definition, seed, false);
    const std::string elastic = shipped.status == StepStatus::AtEnd ? outcome(runFree(definition, seed, true)) : "|";
    fmt::print("| {} | {:.4g} | {:.4g} | {} | {} |\n", definition.name, fmt::join(shipped.start, ", "), fmt::join(shipped.rate, ", "),
               outcome(shipped), elastic);
  }
}

/// Largest |E/E(0) - 1| at the full seconds; the hand is still.
std::string driftOf(const experiment::Experiment& e, const std::vector<double>& q, const std::vector<double>& rate,
                    const SceneOptions& options, int seconds) {
  const Scene scene = compileScene(e, options);
  scene.plant->place(q, rate);
  const HandSample hand{observed(*scene.plant)[0].r, {}, true};
  const HandSegment held = heldSegment(hand.position);
  const double before = scene.plant->energy(hand);
  const int ticks = static_cast<int>(std::lround(1 / options.step));
  double drift = 0;
  for (int second = 0; second < seconds; ++second) {
    for (int tick = 0; tick < ticks; ++tick)
      if (const StepStatus status = scene.plant->step(held, options.step); status != StepStatus::Ok)
        return fmt::format("{} after {} s", describe(status), second);
    drift = std::fmax(drift, std::abs(scene.plant->energy(hand) / before - 1));
  }
  return fmt::format("{:.1e}", drift);
}

struct UndampedScene {
  const char* name;
  experiment::Experiment experiment;
  std::vector<double> q, rate;
  bool linear = false;
};

std::vector<UndampedScene> undampedScenes() {
  experiment::Experiment torus = makePoint(), sphere = torus;
  torus.coupling = sphere.coupling = experiment::Coupling{600, 0};
  torus.constraint.name = "torus";
  sphere.constraint.name = "sphere";
  const experiment::Experiment chain = makeChain(5, 0.6, 600), bead = onCurve(makeChain(1, 1, 600), "0.1*cos(phi)", "0.06*sin(phi)", "0");
  const experiment::Experiment bent = onCurve(chain, "0.1*cos(phi)", "0.06*sin(phi)", "0");
  const experiment::Experiment cusps =
      onCurve(makeChain(1, 1, 600), "0.08*cos(phi) - 0.02*cos(4*phi)", "0.08*sin(phi) - 0.02*sin(4*phi)", "0");
  return {
      {"chain of 5 on the line", chain, {0}, {10}, true},        {"bead on an ellipse", bead, {0.5}, {3}},
      {"the same, fast: 60 rad/s", bead, {0.5}, {60}},           {"the same, 200 rad/s", bead, {0.5}, {200}},
      {"bead through an epicycloid's cusps", cusps, {0.5}, {3}}, {"chain of 5 on an ellipse", bent, {0.5}, {3}},
      {"bead on the torus", torus, {0.5, 0.5}, {3, 2}},          {"bead on the sphere", sphere, {0.5, 0.5}, {3, 2}},
  };
}

void printHour() {
  fmt::print("| undamped scene | exact | abm | adaptive | rk4 |\n|---|---|---|---|---|\n");
  for (const UndampedScene& s : undampedScenes()) {
    fmt::print("| {} | {}", s.name, s.linear ? driftOf(s.experiment, s.q, s.rate, {"exact", 1e-3, 0}, 3600) : "");
    for (const char* method : {"abm", "adaptive", "rk4"}) fmt::print(" | {}", driftOf(s.experiment, s.q, s.rate, {method, 1e-3, 0}, 3600));
    fmt::print(" |\n");
    std::fflush(stdout);
  }
}

/// Three minutes, a twentieth of an hour, with what might make it better.
void printCauses() {
  constexpr int kSeconds = 180;
  constexpr double kStricter = 1e-14;  // than the default of 1e-13
  fmt::print("| undamped scene | abm | adaptive | abm, {0:.0e} | adaptive, {0:.0e} |\n|---|---|---|---|---|\n", kStricter);
  for (const UndampedScene& s : undampedScenes()) {
    fmt::print("| {}", s.name);
    for (const double tolerance : {0.0, kStricter})
      for (const char* method : {"abm", "adaptive"})
        fmt::print(" | {}", driftOf(s.experiment, s.q, s.rate, {method, 1e-3, tolerance}, kSeconds));
    fmt::print(" |\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace reachlab::dynamics

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "hour") reachlab::dynamics::printHour();
  else if (argc > 1 && std::string(argv[1]) == "causes") reachlab::dynamics::printCauses();
  else reachlab::dynamics::printTable(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1);
}
