#include "cli/commands/definition_files.h"

#include <fmt/format.h>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/terminal/message.h"

namespace reachlab::cli {

std::vector<constraints::Definition> ownDefinitions() {
  std::vector<Fault> faults;
  std::vector<constraints::Definition> own = constraints::readDefinitionFolder(constraints::userDefinitionFolder(), faults);
  for (const Fault& fault : faults) fmt::print(stderr, "{}", messageOf(fault, "warning"));
  return own;
}

constraints::Constraint makeAtAllShapes(const constraints::Definition& definition, const std::string& text, const std::string& file) {
  const auto make = [&](const std::map<std::string, double>& shape) {
    try {
      return constraints::makeConstraint(definition, shape, "");
    } catch (const FaultError& error) {
      std::vector<Fault> faults = error.faults;
      for (Fault& fault : faults)
        for (const auto& [name, value] : shape) fault.what = fmt::format("with {} = {}: {}", name, value, fault.what);
      throw FaultError(atTheirPlaces(std::move(faults), text, file));
    }
  };
  constraints::Constraint usual = make({});
  for (const constraints::ShapeParameter& p : definition.shape)
    for (const double value : {p.min, p.max}) make({{p.name, value}});
  return usual;
}

}  // namespace reachlab::cli
