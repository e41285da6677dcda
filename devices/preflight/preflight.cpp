#include "devices/preflight/preflight.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/ticks.h"
#include "devices/preflight/reach_demand.h"
#include "devices/virtual/loop_stability.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/velocity_estimator.h"
#include "sim/trial/protocol.h"

namespace reachlab::devices {
namespace {

constexpr double kRelaxedHandMass = 0.3;    // [kg] that moves with the handle
constexpr double kRelaxedHandDamping = 3;   // [N s/m]; a held hand brings 1 to 10
constexpr double kLightestHandDamping = 1;  // [N s/m]

using experiment::CompiledExperiment;
using experiment::Experiment;

std::string inARelaxedHand(const haptics::DeviceInfo& device) {
  return fmt::format("{} in a relaxed hand ({:g} kg, {:g} N s/m)", device.name, kRelaxedHandMass, kRelaxedHandDamping);
}

// What the hand feels of the springs that it holds: those of parallel masses act together.
experiment::Coupling feltCoupling(const Experiment& experiment, std::size_t hand) {
  const auto together = [](const std::vector<double>& springs) { return std::accumulate(springs.begin(), springs.end(), 0.0); };
  if (hand < experiment.hands.size()) return {together(experiment.hands[hand].stiffness), together(experiment.hands[hand].damping)};
  if (experiment.coupling) return *experiment.coupling;
  return {together(experiment.object.stiffness), together(experiment.object.damping)};
}

// The shortest T whose force keeps below `limit`, to 2 %: force falls about as 1/T^2, and each guess is computed again.
std::optional<double> longerDuration(const CompiledExperiment& experiment, double limit, double ReachDemand::*force,
                                     const ReachDemand& now) {
  constexpr int kTries = 10;  // a force that falls as 1/T needs them
  constexpr double kMargin = 1.01;
  double duration = now.duration, felt = now.*force;
  for (int i = 0; i < kTries; ++i) {
    if (felt <= limit) return duration;
    duration *= kMargin * std::sqrt(felt / limit);
    if (duration > experiment::kMaxDuration) return std::nullopt;  // no task may last as long
    const ReachDemand longer = computeReachDemand(experiment, duration);
    if (longer.law != now.law) return std::nullopt;  // another law does not compare
    felt = longer.*force;
  }
  return felt <= limit ? std::optional(duration) : std::nullopt;
}

/// What was computed without the forces on the hand is no promise.
void doubtWithoutEnvironment(PreflightLine& line, const ReachDemand& demand) {
  if (!demand.withoutEnvironment || line.verdict != Verdict::Fine) return;
  line.verdict = Verdict::Unknown;
  line.sentence += "; the forces of the environment are not counted in it";
}

std::string forceRemedy(const CompiledExperiment& experiment, double limit, double ReachDemand::*force, const ReachDemand& demand) {
  const double scale = limit / (demand.*force);
  const double digit = std::pow(10, std::floor(std::log10(scale)) - 1), down = std::floor(scale / digit + 1e-9) * digit;  // it must help
  const auto duration = longerDuration(experiment, limit, force, demand);
  const std::string slower = duration ? fmt::format("a longer reach (duration_s {:.3g} instead of {:.3g})", *duration, demand.duration)
                                      : std::string("a longer reach does not help (a force that rests on it stays)");
  const char* const smaller = experiment.experiment().environment.empty() ? "a reach or masses" : "a reach, masses or environment";
  return fmt::format("{}, {} scaled by {:.2g}, or a device of {:.3g} N", slower, smaller, down, demand.*force);
}

PreflightLine peakForce(const CompiledExperiment& experiment, const haptics::DeviceInfo& device, const ReachDemand& demand) {
  PreflightLine line{"peak_force", Verdict::Fine, demand.peakForce, device.maxForce, "N", {}, {}};
  if (experiment.experiment().forceLimit) line.limit = std::min(device.maxForce, *experiment.experiment().forceLimit);
  line.sentence =
      fmt::format("the reach needs {:.3g} N at its peak ({}); {} gives {:.3g} N", demand.peakForce, demand.law, device.name, *line.limit);
  doubtWithoutEnvironment(line, demand);
  if (demand.peakForce <= *line.limit) return line;
  line.verdict = Verdict::Warning;
  line.sentence += ": the force will be clamped";
  line.remedy = forceRemedy(experiment, *line.limit, &ReachDemand::peakForce, demand);
  return line;
}

PreflightLine continuousForce(const CompiledExperiment& experiment, const haptics::DeviceInfo& device, const ReachDemand& demand) {
  PreflightLine line{"continuous_force", Verdict::Unknown, demand.rmsForce, std::nullopt, "N", {}, {}};
  if (!(device.maxContinuousForce > 0)) {
    line.sentence = fmt::format("the movement needs {:.3g} N (root mean square); what {} can hold continuously is not known",
                                demand.rmsForce, device.name);
    return line;
  }
  line.limit = device.maxContinuousForce;
  line.sentence = fmt::format("the movement needs {:.3g} N (root mean square); {} can hold {:.3g} N continuously", demand.rmsForce,
                              device.name, *line.limit);
  line.verdict = demand.rmsForce <= *line.limit ? Verdict::Fine : Verdict::Warning;
  doubtWithoutEnvironment(line, demand);
  if (line.verdict != Verdict::Warning) return line;
  const double share = *line.limit / demand.rmsForce;
  line.sentence += ": its motors warm up, and the peak will be taken back";
  line.remedy = fmt::format("pauses {:.2g} times as long as the movements, or {}", 1 / (share * share) - 1,
                            forceRemedy(experiment, *line.limit, &ReachDemand::rmsForce, demand));
  return line;
}

LoopSettings heldLoop(const experiment::Coupling& coupling, const haptics::DeviceInfo& device, const Experiment& experiment) {
  return {.stiffness = coupling.stiffness,
          .damping = coupling.damping,
          .mass = device.apparentMass,
          .friction = device.viscosity,
          .period = std::max(kTickSeconds, device.rate > 0 ? 1 / device.rate : 0.0),
          .estimator = experiment.velocityEstimator};
}

// The damping of a hand that holds the device lightly, as the world sees it.
double lightestDamping(const haptics::DeviceInfo& device) { return kLightestHandDamping / device.scale; }

PreflightLine passivity(const Experiment& experiment, const experiment::Coupling& coupling, const haptics::DeviceInfo& device) {
  const LoopSettings loop = heldLoop(coupling, device, experiment);
  const double margin = passivityMargin(loop), asked = loop.friction - margin;
  PreflightLine line{"passivity", Verdict::Fine, asked, device.viscosity, "N s/m", {}, {}};
  line.sentence = fmt::format(
      "k_h = {:.4g} N/m and b_h = {:.3g} N s/m at {:.4g} Hz ask for {:.3g} N s/m of viscous friction (K T/2 + |B|); "
      "{} has {:.3g} of its own",
      coupling.stiffness, coupling.damping, 1 / loop.period, asked, device.name, device.viscosity);
  if (device.resolution > 0 && device.coulombFriction > 0) {
    const double most = 2 * device.coulombFriction / device.resolution;
    line.sentence += fmt::format("; its steps are swallowed by its dry friction up to k_h = {:.3g} N/m (2 c/resolution)", most);
    if (coupling.stiffness > most) line.verdict = Verdict::Held;
  }
  if (margin < 0) {
    line.verdict = -margin <= lightestDamping(device) ? Verdict::Held : Verdict::Warning;
    line.sentence += fmt::format(": the hand must bring {:.3g} N s/m{}", -margin,
                                 line.verdict == Verdict::Held ? ", as any hand that holds it does" : ", more than a light grasp does");
  }
  if (line.verdict == Verdict::Warning) {
    LoopSettings held = loop;
    held.friction += lightestDamping(device);
    const double softer = largestPassiveStiffness(held);
    line.remedy = softer > 0 ? fmt::format("a coupling of k_h <= {:.4g} N/m", softer)
                             : fmt::format("less coupling damping than b_h = {:.3g} N s/m", coupling.damping);
  }
  return line;
}

// The hand holds the device, whose places are scaled.
LoopSettings withRelaxedHand(LoopSettings loop, const haptics::DeviceInfo& device) {
  loop.mass += kRelaxedHandMass / device.scale;
  loop.friction += kRelaxedHandDamping / device.scale;
  return loop;
}

// Without sentence and remedy. There is no limit where the device's mass is not known.
PreflightLine stiffnessLine(const char* name, const LoopSettings& loop, const haptics::DeviceInfo& device) {
  PreflightLine line{name, Verdict::Unknown, loop.stiffness, std::nullopt, "N/m", {}, {}};
  if (!(loop.mass > 0)) return line;
  line.limit = largestStableStiffness(withRelaxedHand(loop, device));
  line.verdict = loop.stiffness <= *line.limit ? Verdict::Fine : Verdict::Warning;
  return line;
}

PreflightLine stability(const Experiment& experiment, const experiment::Coupling& coupling, const haptics::DeviceInfo& device) {
  PreflightLine line = stiffnessLine("stability", heldLoop(coupling, device, experiment), device);
  if (!line.limit) {
    line.sentence = fmt::format("the apparent mass of {} is not known, so how stiff a coupling it renders cannot be told", device.name);
    return line;
  }
  line.sentence = fmt::format("k_h = {:.4g} N/m; {} is stable up to {:.4g} N/m", coupling.stiffness, inARelaxedHand(device), *line.limit);
  if (line.verdict == Verdict::Warning) line.remedy = fmt::format("a coupling of k_h <= {:.4g} N/m", *line.limit);
  return line;
}

// The hand feels the wall beside the object, both in the same direction at worst.
PreflightLine channelLine(const Experiment& experiment, const experiment::Coupling& coupling, const experiment::ChannelForce& wall,
                          const haptics::DeviceInfo& device) {
  const experiment::Coupling felt{coupling.stiffness + wall.stiffness, coupling.damping + wall.damping};
  LoopSettings loop = heldLoop(felt, device, experiment);
  PreflightLine line = stiffnessLine("channel", loop, device);
  const double asked = loop.friction - passivityMargin(loop);
  const std::string passive = fmt::format("Colgate's condition asks for {:.3g} N s/m of friction (K T/2 + |B|), and {} has {:.3g}", asked,
                                          device.name, device.viscosity);
  if (!line.limit) {
    line.sentence = fmt::format("the channel's wall has {:.4g} N/m; the apparent mass of {} is not known, so its limit cannot be told; {}",
                                wall.stiffness, device.name, passive);
    return line;
  }
  line.sentence =
      fmt::format("the hand feels {:.4g} N/m and {:.3g} N s/m in the channel; {} is stable up to {:.4g} N/m, {:.2g} times as much; {}",
                  felt.stiffness, felt.damping, inARelaxedHand(device), *line.limit, *line.limit / felt.stiffness, passive);
  if (line.verdict != Verdict::Warning) return line;
  loop.damping = coupling.damping;
  line.remedy = fmt::format("a channel of stiffness_n_per_m <= {:.4g}, or less damping_n_s_per_m (without it {:.4g} N/m are stable)",
                            std::max(0.0, *line.limit - coupling.stiffness), largestStableStiffness(withRelaxedHand(loop, device)));
  return line;
}

// Half of the antisymmetric part's norm: the coefficient of the curl in its own plane.
double curlOf(const experiment::SquareMatrix<3>& b) { return 0.5 * std::hypot(b[0][1] - b[1][0], b[0][2] - b[2][0], b[1][2] - b[2][1]); }

PreflightLine fieldPower(const CompiledExperiment& compiled, double curl, const haptics::DeviceInfo& device) {
  const Experiment& experiment = compiled.experiment();
  const trial::ProtocolSettings settings = trial::makeProtocolSettings(experiment, compiled.constraint());
  const double radius = norm(settings.target - settings.start) / 2, omega = std::numbers::pi / experiment.task->duration;
  const double speed = omega * radius, delay = haptics::velocityDelay(experiment.velocityEstimator);
  const double friction = device.viscosity + lightestDamping(device);
  PreflightLine line{"field_power", Verdict::Fine, curl * speed * speed * std::sin(omega * delay), friction * speed * speed, "W", {}, {}};
  line.sentence = fmt::format(
      "the curl field of {:.4g} N s/m gives {:.3g} W on average, because the velocity estimate lags by {:.2g} ms "
      "(b v^2 sin(w d) at {:.3g} m/s on a circle); the friction of {} and of a light hand takes {:.3g} W",
      curl, line.asked, 1e3 * delay, speed, device.name, *line.limit);
  if (line.asked <= *line.limit) return line;
  line.verdict = Verdict::Warning;
  line.sentence += ": the field drives the hand";
  line.remedy = fmt::format("a weaker matrix_n_s_per_m (b <= {:.3g} N s/m), a longer reach, or a velocity_estimator that lags less",
                            friction / std::sin(omega * delay));
  return line;
}

void checkEnvironment(const CompiledExperiment& compiled, const experiment::Coupling& coupling, const haptics::DeviceInfo& device,
                      std::vector<PreflightLine>& lines) {
  const Experiment& experiment = compiled.experiment();
  experiment::SquareMatrix<3> sum{};
  for (std::size_t f = 0; f < experiment.environment.size(); ++f) {
    const experiment::ForceLaw& law = experiment.environment[f].law;
    if (const auto* wall = std::get_if<experiment::ChannelForce>(&law)) {
      lines.push_back(channelLine(experiment, coupling, *wall, device));
      lines.back().sentence = fmt::format("environment[{}]: {}", f, lines.back().sentence);
    }
    if (const auto* field = std::get_if<experiment::ViscousForce>(&law))
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum[i][j] += field->matrix[i][j];
  }
  if (const double curl = curlOf(sum); curl > 0) lines.push_back(fieldPower(compiled, curl, device));
}

PreflightLine workspace(const haptics::DeviceInfo& device, const ReachDemand& demand) {
  PreflightLine line{"workspace", Verdict::Unknown, demand.farthest, std::nullopt, "m", {}, {}};
  if (!(device.workspaceRadius > 0)) {
    line.sentence = fmt::format("the hand goes {:.3g} m from its middle; the workspace of {} is not known", demand.farthest, device.name);
    return line;
  }
  line.limit = device.workspaceRadius;
  constexpr double kRounding = 1e-6;
  line.verdict = demand.farthest <= *line.limit * (1 + kRounding) ? Verdict::Fine : Verdict::Warning;
  line.sentence = fmt::format("the hand goes {:.3g} m from its middle; {} reaches {:.3g} m", demand.farthest, device.name, *line.limit);
  if (line.verdict == Verdict::Warning)
    line.remedy = fmt::format(
        "places of the task (start, target, via_m) nearer to the middle, a scale {:.3g} times as large (a mapping), or another offset",
        demand.farthest / *line.limit);
  return line;
}

}  // namespace

std::string_view nameOf(Verdict verdict) {
  constexpr std::string_view kNames[] = {"fine", "held", "warning", "unknown"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Verdict::Unknown) + 1);
  return kNames[static_cast<std::size_t>(verdict)];
}

std::vector<PreflightLine> checkBeforeBlock(const CompiledExperiment& experiment, const haptics::DeviceInfo& device, std::size_t hand) {
  const experiment::Coupling coupling = feltCoupling(experiment.experiment(), hand);
  const ReachDemand demand = computeReachDemand(experiment, std::nullopt, device.workspaceCentre);
  std::vector<PreflightLine> lines;
  if (device.rendersForce) {
    lines.push_back(peakForce(experiment, device, demand));
    lines.push_back(continuousForce(experiment, device, demand));
    if (experiment.experiment().object.kind != experiment::ObjectKind::None) {
      lines.push_back(passivity(experiment.experiment(), coupling, device));
      lines.push_back(stability(experiment.experiment(), coupling, device));
    }
    checkEnvironment(experiment, coupling, device, lines);
  }
  lines.push_back(workspace(device, demand));
  return lines;
}

namespace {

// Of every hand, or of those that feel a force.
std::vector<PreflightLine> linesOf(const CompiledExperiment& experiment, haptics::HapticDevice& device, bool feltOnly) {
  const std::vector<haptics::HapticDevice*> hands = device.hands();
  std::vector<PreflightLine> all;
  for (std::size_t i = 0; i < hands.size(); ++i) {
    const haptics::DeviceInfo info = hands[i]->info();
    if (feltOnly && !info.rendersForce) continue;
    for (PreflightLine& line : checkBeforeBlock(experiment, info, i)) {
      line.hand = hands.size() > 1 ? static_cast<int>(i) + 1 : 0;
      all.push_back(std::move(line));
    }
  }
  return all;
}

}  // namespace

std::vector<PreflightLine> checkBeforeBlock(const CompiledExperiment& experiment, haptics::HapticDevice& device) {
  return linesOf(experiment, device, false);
}

std::string describe(const PreflightLine& line) {
  std::string name = line.name;
  std::replace(name.begin(), name.end(), '_', ' ');
  return fmt::format("{}{}: {}{}", line.hand > 0 ? fmt::format("hand {}: ", line.hand) : "", name, line.sentence,
                     line.remedy.empty() ? "" : "; what helps: " + line.remedy);
}

std::vector<std::string> warningsBeforeBlock(std::span<const CompiledExperiment> scenes, haptics::HapticDevice& device) {
  std::vector<std::string> warnings;
  for (const CompiledExperiment& scene : scenes) {
    if (!scene.experiment().task) continue;
    for (const PreflightLine& line : linesOf(scene, device, true))
      if (std::string sentence = describe(line);
          line.verdict == Verdict::Warning && std::find(warnings.begin(), warnings.end(), sentence) == warnings.end())
        warnings.push_back(std::move(sentence));
  }
  return warnings;
}

}  // namespace reachlab::devices
