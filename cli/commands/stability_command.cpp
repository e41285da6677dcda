#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>

#include "analysis/figure/figure.h"
#include "base/fault.h"
#include "cli/commands/commands.h"
#include "devices/virtual/loop_stability.h"
#include "devices/virtual/virtual_device.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::cli {
namespace {

struct StabilityRequest {
  std::string model, out;
  devices::StabilityMapSettings settings;
  double coupling = 600;  // [N/m] shown as a line
};

std::string tableOf(const std::vector<devices::StabilityPoint>& map) {
  std::string text = "hand_damping_n_s_per_m,damping_n_s_per_m,largest_stable_stiffness_n_per_m,largest_passive_stiffness_n_per_m\n";
  for (const auto& p : map)
    text += fmt::format("{:.17g},{:.17g},{:.17g},{:.17g}\n", p.handDamping, p.damping, p.largestStable, p.largestPassive);
  return text;
}

figure::Figure figureOf(const devices::DeviceModel& model, const StabilityRequest& request,
                        const std::vector<devices::StabilityPoint>& map) {
  figure::Panel panel{.title = fmt::format("{}, hand of {:g} kg", model.title, request.settings.handMass),
                      .x = {.label = "Coupling damping b_h (N s/m)"},
                      .y = {.label = "Largest coupling stiffness k_h (N/m)", .scale = figure::Scale::Log},
                      .rules = {{request.coupling, false, fmt::format("k_h = {:g}", request.coupling)}},
                      .legend = figure::LegendPlace::Right};
  int index = 0;
  for (const double hand : request.settings.handDampings) {
    const figure::Color color = figure::palette::series(index++);
    figure::Series stable{.label = fmt::format("stable, hand {:g} N s/m", hand), .color = color};
    figure::Series passive{.label = fmt::format("passive (Colgate), hand {:g} N s/m", hand), .color = color, .dash = figure::Dash::Dashed};
    for (const auto& p : map) {
      if (p.handDamping != hand) continue;
      stable.x.push_back(p.damping), stable.y.push_back(p.largestStable);
      if (p.largestPassive > 0) passive.x.push_back(p.damping), passive.y.push_back(p.largestPassive);
    }
    panel.series.push_back(std::move(stable));
    if (!passive.x.empty()) panel.series.push_back(std::move(passive));
  }
  return {.panels = {std::move(panel)}, .panelWidth = 100, .panelHeight = 70};
}

void drawMap(const StabilityRequest& request) {
  const devices::DeviceModel* model = devices::findDeviceModel(request.model);
  if (model == nullptr)
    throw FaultError(Fault{"model", "is " + request.model + ", which is unknown; `reach list devices` has them as virtual:MODEL"});
  const auto map = devices::computeStabilityMap(*model, request.settings);
  if (request.out.empty()) {
    fmt::print("{}", tableOf(map));
    return;
  }
  const std::string stem = request.out + "/stability-" + request.model;
  record::writeFileAtomically(stem + ".csv", tableOf(map));
  record::writeFileAtomically(stem + ".svg", figure::renderSvg(figureOf(*model, request, map)));
  fmt::print(stderr, "{}.{{csv,svg}}\n", stem);
}

}  // namespace

void addStabilityCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("stability", "Largest coupling stiffness that a held device renders stably");
  const auto r = std::make_shared<StabilityRequest>();
  command->add_option("model", r->model, "Device: omni, premium15, premium60, highforce, omega3, inverse3")->required();
  command->add_option("--hand-mass", r->settings.handMass, "Mass of the hand that moves with the handle [default: 0.3 kg]")
      ->check(CLI::Range(0.0, 50.0));
  command->add_option("--hand-damping", r->settings.handDampings, "Dampings of the hand [default: 0.5 1 3 10 N s/m]")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--damping", r->settings.mostDamping, "Coupling damping b_h from 0 to this [default: 20 N s/m]")
      ->check(CLI::Range(0.0, 1000.0));
  command->add_option("--step", r->settings.dampingStep, "Step of b_h [default: 0.25 N s/m]")->check(CLI::Range(0.01, 1000.0));
  command->add_option("--delay-ms", r->settings.delayTicks, "Delay of the device beyond the tick's own [default: 0 ms]")
      ->check(CLI::Range(0, devices::VirtualDevice::kMostDelay - 1));
  command->add_option("--out", r->out, "Folder for the table and the figure [default: the table to stdout]");
  command->footer(
      "Linear: Coulomb friction and encoder steps are left out. `passive` is Colgate's bound, 2 (b - |b_h|)/(T (1 + 2 d)) with d ms of delay.\n\n"
      "Examples:\n  reach stability premium15 --out stability\n  reach stability omni --hand-damping 1 --delay-ms 2");
  command->callback([r] { drawMap(*r); });
}

}  // namespace reachlab::cli
