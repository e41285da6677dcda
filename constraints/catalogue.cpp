#include "constraints/definition.h"

namespace reachlab {

const std::vector<Definition>& catalogue() {
  static const std::vector<Definition> definitions = [] {
    Definition line;
    line.name = "line";
    line.coordinates = {"length_m*(phi/(2*pi) - 1/2)", "0", "0"};
    line.shape = {{"length_m", 0.2, 0.01, 1, "m", "distance from start to target"}};
    line.start = {0};
    line.target = {6.283185307179586};
    return std::vector<Definition>{line};
  }();
  return definitions;
}

const Definition* findInCatalogue(const std::string& name) {
  for (const Definition& definition : catalogue())
    if (definition.name == name) return &definition;
  return nullptr;
}

GeneratedFunctions generatedFunctions(const Definition&) { return {}; }

}  // namespace reachlab
