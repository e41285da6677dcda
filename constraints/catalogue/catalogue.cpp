#include <algorithm>

#include "base/fault.h"
#include "base/names.h"
#include "base/text_file.h"
#include "constraints/catalogue/definition.h"
#include "constraints/catalogue/generated_catalogue.h"

namespace reachlab::constraints {
namespace {

struct Entry {
  Definition definition;
  GeneratedFunctions functions;
};

// Parsed once; immutable from then on.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> list;
    for (const GeneratedEntry& e : generatedEntries())
      list.push_back({parseDefinition(e.text, "catalogue"), {e.curve, e.curveBatch, e.surface}});
    std::stable_sort(list.begin(), list.end(), [](const Entry& a, const Entry& b) { return a.definition.kind < b.definition.kind; });
    return list;
  }();
  return all;
}

}  // namespace

const std::vector<Definition>& catalogue() {
  static const std::vector<Definition> definitions = [] {
    std::vector<Definition> list;
    for (const Entry& e : entries()) list.push_back(e.definition);
    return list;
  }();
  return definitions;
}

const Definition* findInCatalogue(const std::string& name) {
  for (const Definition& definition : catalogue())
    if (definition.name == name) return &definition;
  return nullptr;
}

Definition findDefinition(const std::string& name, const std::string& key) {
  // A user's own, saved under its name; a name with a path in it is none.
  const std::string file = userDefinitionFolder() + "/" + name + ".json";
  const bool isOwn = !name.empty() && name.find_first_of("/\\.") == std::string::npos && isFile(file);
  if (const Definition* shipped = findInCatalogue(name)) {
    if (isOwn)
      throw FaultError(Fault{keyIn(key, "name"), "is '" + name + "', the name of a shipped constraint and of " + file,
                             "one of the two: give the file and its `name` another name"});
    return *shipped;
  }
  if (isOwn) return readNamedDefinition(file);
  std::vector<std::string> known{"free"};
  for (const Definition& definition : catalogue()) known.push_back(definition.name);
  throw FaultError(Fault{keyIn(key, "name"), "there is no constraint '" + name.substr(0, 60) + "'" + didYouMean(name, known),
                         "free, or a name of the catalogue"});
}

GeneratedFunctions generatedFunctions(const Definition& definition) {
  for (const Entry& e : entries())
    if (e.definition.name == definition.name) {
      const FormulaText ours = formulaOf(e.definition), theirs = formulaOf(definition);
      const bool same = ours.kind == theirs.kind && ours.coordinates == theirs.coordinates && ours.parameters == theirs.parameters;
      return same ? e.functions : GeneratedFunctions{};
    }
  return {};
}

}  // namespace reachlab::constraints
