#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/commands/commands.h"
#include "cli/commands/definition_files.h"
#include "cli/output/json_text.h"
#include "constraints/catalogue/definition.h"
#include "devices/driver/registry.h"
#include "sim/experiment/describe.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/predict/predict.h"
#include "sim/session/plan.h"

namespace reachlab::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string describeMasses(const std::vector<double>& masses) {
  const bool alike = std::all_of(masses.begin(), masses.end(), [&](double mass) { return mass == masses[0]; });
  if (!alike) return fmt::format("{} masses, {:.4g} kg in all", masses.size(), std::accumulate(masses.begin(), masses.end(), 0.0));
  return masses.size() == 1 ? fmt::format("{:.4g} kg", masses[0]) : fmt::format("{} x {:.4g} kg", masses.size(), masses[0]);
}

std::string inShort(const experiment::Experiment& e) {
  const char* kinds[] = {"point of ", "chain of ", "parallel masses: ", "body of "};
  const bool bare = e.object.kind == experiment::ObjectKind::None;
  const std::string& constraint = e.constraint.name;
  return fmt::format(
      "{}{}{}{}{}", bare ? "hand alone" : kinds[static_cast<int>(e.object.kind)] + describeMasses(e.object.masses),
      e.environment.empty() ? "" : fmt::format(", {} force{} on it", e.environment.size(), e.environment.size() == 1 ? "" : "s"),
      constraint == "free" ? ", free in space"
      : constraint.empty() ? " on a formula"
                           : " on " + constraint,
      e.hands.size() > 1 ? fmt::format(", {} hands", e.hands.size()) : "", e.task ? ", " + experiment::describePace(*e.task) : "");
}

Json listExperiments() {
  Json rows = Json::array();
  std::vector<std::string> names = experiment::shippedExperiments();
  const std::vector<std::string> forTwo = experiment::shippedForTwoHands();
  names.insert(names.end(), forTwo.begin(), forTwo.end());
  for (const std::string& name : names) rows.push_back({{"name", name}, {"description", inShort(experiment::readExperiment(name))}});
  return rows;
}

Json listPlans() {
  Json rows = Json::array();
  for (const std::string& name : session::shippedPlans()) {
    const session::Plan plan = session::readPlan(*session::findPlan(name));
    int trials = 0, days = 1;
    for (const session::PlanBlock& block : plan.blocks) trials += block.trials, days = std::max(days, block.day);
    rows.push_back({{"name", name},
                    {"description", fmt::format("{} blocks, {} trials in all{}", plan.blocks.size(), trials,
                                                days > 1 ? fmt::format(", {} days", days) : "")}});
  }
  return rows;
}

Json listConstraints() {
  Json rows = Json::array({{{"name", "free"}, {"kind", "free"}, {"description", "Nothing binds the object."}}});
  const auto add = [&](const constraints::Definition& d) {
    rows.push_back(
        {{"name", d.name}, {"kind", d.kind == constraints::ConstraintKind::Curve ? "curve" : "surface"}, {"description", d.sentence}});
  };
  for (const constraints::Definition& d : constraints::catalogue()) add(d);
  for (const constraints::Definition& d : ownDefinitions()) add(d);
  return rows;
}

Json listMethods() {
  return Json::array({{{"name", "auto"}, {"description", "chosen for the scene from its fastest mode and geometry"}},
                      {{"name", "rk4"}, {"description", "Runge-Kutta of order 4 at the tick, as in the paper"}},
                      {{"name", "exact"}, {"description", "matrix exponential; linear scenes (straight line, free) only"}},
                      {{"name", "abm"}, {"description", "Adams-Bashforth-Moulton predictor-corrector at the tick"}},
                      {{"name", "adaptive"}, {"description", "embedded pair of high order that sub-steps within the tick"}},
                      {{"name", "stiff"}, {"description", "L-stable implicit method for damped light masses"}}});
}

Json listCriteria() {
  Json rows = Json::array();
  for (const predict::Criterion criterion : predict::kAllCriteria)
    rows.push_back({{"name", predict::nameOf(criterion)}, {"description", predict::describe(criterion)}});
  return rows;
}

template <typename Number>
Json orNull(const std::optional<Number>& number) {
  return number ? Json(*number) : Json(nullptr);
}

Json listDevices() {
  Json rows = Json::array();
  for (const devices::FoundDevice& d : devices::findDevices())
    rows.push_back({{"name", d.name},
                    {"kind", d.kind},
                    {"description", d.description},
                    {"present", d.present},
                    {"why_not", d.present ? Json(nullptr) : Json(d.whyNot)},
                    {"degrees_of_freedom", orNull(d.degreesOfFreedom)},
                    {"max_force_n", orNull(d.maxForce)},
                    {"continuous_force_n", orNull(d.continuousForce)},
                    {"rate_hz", orNull(d.rate)}});
  return rows;
}

// What it can do, or why it is not there.
std::string describeDevice(const Json& row) {
  const std::string what = row["description"];
  if (!row["present"]) return fmt::format("{}: not there: {}", what, row["why_not"].get<std::string>());
  if (!row["max_force_n"].is_number() || row["max_force_n"] == 0) return what;
  const std::string continuous =
      row["continuous_force_n"].is_number() ? fmt::format(", {} N continuously", row["continuous_force_n"].get<double>()) : "";
  return fmt::format("{} ({} N{})", what, row["max_force_n"].get<double>(), continuous);
}

}  // namespace

void addListCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("list", "List what can be named on the command line");
  const auto what = std::make_shared<std::string>();
  const auto asJson = std::make_shared<bool>(false);
  command->add_option("what", *what, "experiments, plans, constraints, methods, criteria or devices")
      ->required()
      ->check(CLI::IsMember({"experiments", "plans", "constraints", "methods", "criteria", "devices"}));
  command->add_flag("--json", *asJson, "an array of objects with `name`");
  command->footer("Examples:\n  reach list experiments\n  reach list constraints --json");
  command->callback([what, asJson] {
    static const std::map<std::string_view, Json (*)()> kLists{{"experiments", listExperiments}, {"plans", listPlans},
                                                               {"constraints", listConstraints}, {"methods", listMethods},
                                                               {"criteria", listCriteria},       {"devices", listDevices}};
    const Json rows = kLists.at(*what)();
    if (*asJson) {
      fmt::print("{}", jsonText(rows));
      return;
    }
    for (const Json& row : rows)
      fmt::print("{:<24} {}\n", row["name"].get<std::string>(),
                 *what == "devices" ? describeDevice(row) : row["description"].get<std::string>());
  });
}

}  // namespace reachlab::cli
