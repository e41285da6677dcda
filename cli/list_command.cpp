#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "constraints/definition.h"
#include "devices/make_device.h"
#include "sim/experiment/experiment.h"
#include "sim/predict/predict.h"

namespace reachlab {
namespace {

using Json = nlohmann::ordered_json;

std::string describe(const Experiment& e) {
  const char* kinds[] = {"point", "chain", "parallel", "body"};
  return fmt::format("{} of {} ({} kg) on {}{}", kinds[static_cast<int>(e.object.kind)], e.object.masses.size(), e.object.masses[0],
                     e.constraint.name.empty() ? "a formula" : e.constraint.name,
                     e.task ? fmt::format(", {} +- {} s", e.task->duration, e.task->tolerance.time) : "");
}

Json listExperiments() {
  Json rows = Json::array();
  for (const std::string& name : shippedExperiments()) rows.push_back({{"name", name}, {"description", describe(readExperiment(name))}});
  return rows;
}

Json listConstraints() {
  Json rows = Json::array({{{"name", "free"}, {"kind", "free"}, {"description", "Nothing binds the object."}}});
  for (const Definition& d : catalogue())
    rows.push_back({{"name", d.name}, {"kind", d.kind == ConstraintKind::Curve ? "curve" : "surface"}, {"description", d.sentence}});
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
  for (int i = 0; i < kCriterionCount; ++i) {
    const auto criterion = static_cast<Criterion>(i);
    rows.push_back({{"name", nameOf(criterion)}, {"description", describe(criterion)}});
  }
  return rows;
}

Json listDevices() {
  Json rows = Json::array();
  for (const DeviceDescription& device : knownDevices()) rows.push_back({{"name", device.name}, {"description", device.description}});
  return rows;
}

}  // namespace

void addListCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("list", "List what can be named on the command line");
  const auto what = std::make_shared<std::string>();
  const auto asJson = std::make_shared<bool>(false);
  command->add_option("what", *what, "experiments, constraints, methods, criteria or devices")
      ->required()
      ->check(CLI::IsMember({"experiments", "constraints", "methods", "criteria", "devices"}));
  command->add_flag("--json", *asJson, "an array of objects with `name`");
  command->footer("Examples:\n  reach list experiments\n  reach list constraints --json");
  command->callback([what, asJson] {
    const Json rows = *what == "experiments"   ? listExperiments()
                      : *what == "constraints" ? listConstraints()
                      : *what == "methods"     ? listMethods()
                      : *what == "criteria"    ? listCriteria()
                                               : listDevices();
    if (*asJson) {
      std::puts(rows.dump(2).c_str());
      return;
    }
    for (const Json& row : rows) fmt::print("{:<24} {}\n", row["name"].get<std::string>(), row["description"].get<std::string>());
  });
}

}  // namespace reachlab
