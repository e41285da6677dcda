#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/commands.h"
#include "cli/output/json_text.h"
#include "devices/replay/velocity_table.h"
#include "sim/experiment/resources.h"

namespace reachlab::cli {
namespace {

struct VelocityRequest {
  std::string reaches;
  std::vector<double> millimetres;
  devices::VelocityTableSettings settings;
  bool json = false;
};

void compare(const VelocityRequest& r) {
  devices::VelocityTableSettings settings = r.settings;
  if (!r.millimetres.empty()) settings.resolutions.clear();
  for (const double mm : r.millimetres) settings.resolutions.push_back(mm * 1e-3);
  const auto rows = devices::compareVelocityEstimators(r.reaches.empty() ? experiment::resourceFolder() + "/reaches" : r.reaches, settings);
  if (r.json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& row : rows)
      list.push_back({{"name", row.kind},
                      {"resolution_m", row.resolution},
                      {"delay_s", row.delay},
                      {"noise_m_per_s", row.noise},
                      {"error_m_per_s", row.error},
                      {"worst_m_per_s", row.worst}});
    fmt::print("{}", jsonText(list));
    return;
  }
  fmt::print("{:<16} {:>9} {:>9} {:>11} {:>11} {:>11}\n", "estimator", "step (mm)", "delay ms", "noise mm/s", "error mm/s", "worst mm/s");
  for (const auto& row : rows)
    fmt::print("{:<16} {:>9.3g} {:>9.2f} {:>11.2f} {:>11.2f} {:>11.1f}\n", row.kind, row.resolution * 1e3, row.delay * 1e3, row.noise * 1e3,
               row.error * 1e3, row.worst * 1e3);
}

}  // namespace

void addVelocityCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("velocity", "Compares the estimators of the hand's velocity on recorded reaches");
  const auto r = std::make_shared<VelocityRequest>();
  command->add_option("--reaches", r->reaches, "File or folder of reaches [default: the shipped ones, of people]");
  command->add_option("--step-mm", r->millimetres, "Encoder steps at the handle [default: 0.02 0.055 0.1 mm]")
      ->check(CLI::Range(1e-6, 10.0));
  command->add_option("--cutoff", r->settings.cutoff, "Cut-off of the estimators that have one [default: 40 Hz]")
      ->check(CLI::Range(0.1, 400.0));
  command->add_flag("--json", r->json, "an array of objects");
  command->footer(
      "Noise is what is left (RMS an axis) when the delay is taken off, error what the coupling sees. A device's own estimate is its\n"
      "maker's and is not in the table.\n\nExamples:\n  reach velocity\n  reach velocity --step-mm 0.03 --cutoff 30");
  command->callback([r] { compare(*r); });
}

}  // namespace reachlab::cli
