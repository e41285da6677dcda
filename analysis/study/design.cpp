#include "analysis/study/design.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "analysis/study/columns.h"
#include "analysis/study/points.h"
#include "base/json/json_reader.h"
#include "base/names.h"
#include "base/text_file.h"
#include "constraints/catalogue/definition.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/patch.h"

namespace reachlab::study {
namespace {

namespace fs = std::filesystem;
constexpr double kMostSeed = 9007199254740992.0;  // a JSON number is read as a double: whole up to 2^53
constexpr std::int64_t kMaxValues = 1'000'000;

// What an option of the simulated device is given as: text without quotes.
std::optional<std::string> optionText(const JsonNode& node) {
  if (node.kind == JsonNode::Kind::String) return node.string;
  if (node.kind == JsonNode::Kind::Number) return fmt::format("{}", node.number);
  return std::nullopt;
}

constexpr const char* kOption = "a number or a word";
// What holds the options of a device apart is in no option.
bool isOption(const std::optional<std::string>& text) { return text && text->find_first_of(",=:") == std::string::npos; }

void readSubject(ObjectReader& reader, Design& design) {
  const JsonNode* node = reader.optional("subject");
  if (node == nullptr) return;
  if (node->kind != JsonNode::Kind::Object) return reader.faults().add(*node, "subject", "is no object", "options of the simulated device");
  for (const auto& [key, value] : node->members) {
    const auto text = optionText(value);
    if (!isOption(text)) reader.faults().add(value, "subject." + key, "is no option", kOption);
    else design.subject.emplace_back(key, *text);
  }
}

void readNames(ObjectReader& reader, const std::string& key, std::vector<std::string>& names) {
  const JsonNode* node = reader.optional(key);
  if (node != nullptr) reader.strings(*node, key, static_cast<int>(node->items.size()), names);
}

// {from, to, step}: both ends, the last where the steps meet it to a millionth of one.
void readSteps(ObjectReader& axis, VariedKey& out) {
  double from = 0, to = 0, step = 0;
  const bool all = axis.requiredNumber("from", anyNumber(), from) & axis.requiredNumber("to", anyNumber(), to) &
                   axis.requiredNumber("step", positive(""), step);
  if (!all) return;
  const double count = std::floor((to - from) / step + 1e-6);
  if (!(to >= from) || !(count < static_cast<double>(kMaxValues)))
    return axis.faults().add(axis.node(), axis.keyPath("to"), "gives no values, or more than a million", "from <= to");
  for (std::int64_t i = 0; i <= static_cast<std::int64_t>(count); ++i)
    out.values.push_back(fmt::format("{}", from + static_cast<double>(i) * step));
}

std::int64_t readUniform(ObjectReader& axis, VariedKey& out) {
  int n = 0;
  std::vector<double> range;
  if (const JsonNode* node = axis.required("uniform", "[from, to]")) axis.numbers(*node, "uniform", 2, anyNumber(), range);
  if (axis.required("n", "how many are drawn") != nullptr) axis.integer("n", 1, static_cast<int>(kMaxPoints), n);
  if (range.size() == 2 && !(range[0] <= range[1]))
    axis.faults().add(axis.node(), axis.keyPath("uniform"), "is no range", "[from, to], from <= to");
  else if (range.size() == 2) out.uniform = {range[0], range[1]};
  return n;
}

void readAxes(ObjectReader& reader, Design& design) {
  const JsonNode* node = reader.optional("vary");
  if (node == nullptr) return;
  if (node->kind != JsonNode::Kind::Object) return reader.faults().add(*node, "vary", "is no object", "keys with their values");
  std::optional<std::int64_t> samples;
  for (const auto& [path, value] : node->members) {
    VariedKey axis;
    axis.path = path;
    const std::string key = "vary." + path;
    for (const VariedKey& before : design.axes)
      if (experiment::nameOneValue(before.path, path))
        reader.faults().add(value, key, fmt::format("sets a value that vary.{} sets, too", before.path), "each value in one key");
    if (value.kind == JsonNode::Kind::Array) {
      for (const JsonNode& item : value.items) {
        axis.values.push_back(experiment::valueText(item));
        if (path.starts_with("subject.") && !isOption(optionText(item))) reader.faults().add(item, key, "is no option", kOption);
      }
      if (axis.values.empty()) reader.faults().add(value, key, "is empty", "one value or more");
    } else if (value.kind == JsonNode::Kind::Object) {
      ObjectReader inner(reader.faults(), value, key);
      if (value.find("uniform") != nullptr) {
        const std::int64_t n = readUniform(inner, axis);
        if (samples && *samples != n)
          reader.faults().add(value, key + ".n", fmt::format("is {}, and {} before", n, *samples), "one number of draws for all");
        samples = n;
      } else {
        readSteps(inner, axis);
      }
      inner.finish();
    } else {
      reader.faults().add(value, key, "is no list of values", "[…], { from, to, step } or { uniform: [from, to], n }");
    }
    design.axes.push_back(std::move(axis));
  }
  design.samples = samples.value_or(1);
}

void keepDefinition(Design& design, const std::string& name) {
  if (!name.empty() && name != "free" && constraints::findInCatalogue(name) == nullptr)
    design.definitionTexts[name] = constraints::toJson(constraints::findDefinition(name, "constraint"));
}

/// A change of an experiment may name another constraint.
void keepDefinitionIn(Design& design, const std::string& path, const std::string& value) {
  if (path == "constraint.name") keepDefinition(design, unquoted(value));
}

void readExperiments(const JsonNode& root, Design& design, FaultList& faults) {
  const auto take = [&](const JsonNode& where, const std::string& key, const std::string& name, const std::string& file) {
    try {
      const experiment::Experiment experiment = experiment::readExperiment(file);
      const std::string& text = experiment.text;
      keepDefinition(design, experiment.constraint.name);
      if (const auto [known, fresh] = design.experimentTexts.emplace(name, text); !fresh && known->second != text)
        faults.add(where, key, fmt::format("names two experiments {}", name), "one experiment a name");
    } catch (const FaultError& error) {
      faults.add(where, key, error.what());
    }
  };
  if (!design.experiment.empty())
    take(*root.find("experiment"), "experiment", design.experiment, besideFile(design.file, design.experiment));
  for (const VariedKey& axis : design.axes) {
    try {
      for (const std::string& value : axis.values) keepDefinitionIn(design, axis.path, value);
    } catch (const FaultError& error) {
      faults.add(*root.find("vary")->find(axis.path), "vary." + axis.path, error.what());
    }
    if (axis.path != "experiment") continue;
    const JsonNode& node = *root.find("vary")->find("experiment");
    if (node.kind != JsonNode::Kind::Array) faults.add(node, "vary.experiment", "is no list", "names of experiments");
    for (const JsonNode& item : node.items)
      if (item.kind == JsonNode::Kind::String) take(item, "vary.experiment", item.string, besideFile(design.file, item.string));
      else faults.add(item, "vary.experiment", "is no name", "names of experiments");
  }
  if (design.plan.empty()) return;
  const JsonNode& where = *root.find("plan");
  if (const auto found = session::findPlan(besideFile(design.file, design.plan))) {
    design.plan = fs::path(*found).filename().string();
    design.planText = readTextFile(*found);
    try {
      for (const session::PlanBlock& block : session::parsePlan(design.planText, *found).blocks) {
        take(where, "plan", experimentNameOf(block), block.experiment);
        for (const experiment::Patch& change : block.changes) keepDefinitionIn(design, change.path, change.value);
      }
    } catch (const FaultError& error) {
      faults.add(where, "plan", error.what());
    }
  } else {
    faults.add(where, "plan", fmt::format("is {}, which is not there", design.plan), "a file, or the name of a shipped plan");
  }
}

}  // namespace

std::string experimentNameOf(const session::PlanBlock& block) { return fs::path(block.experiment).filename().string(); }

Design parseDesign(const std::string& text, const std::string& file, const std::optional<NamedTexts>& named) {
  const JsonNode root = parseJson(text, file);
  FaultList faults(file);
  Design design;
  design.name = nameOfFile(file);
  design.text = text;
  design.file = file;
  ObjectReader reader(faults, root, "");
  double version = 1, seed = 0, subjects = 1;
  reader.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
  reader.text("name", design.name);
  std::string description;
  reader.text("description", description);
  reader.number("seed", wholeNumber(0, kMostSeed), seed);
  reader.text("experiment", design.experiment);
  reader.text("plan", design.plan);
  readSubject(reader, design);
  reader.requiredNumber("subjects", wholeNumber(1, static_cast<double>(kMaxSubjects)), subjects);
  reader.integer("trials", 1, 1'000'000, design.trials);
  readAxes(reader, design);
  readNames(reader, "measures", design.measures);
  readNames(reader, "criteria", design.criteria);
  reader.boolean("profiles", design.profiles);
  reader.integer("chunk_trials", 1, 1'000'000, design.chunkTrials);
  reader.finish();
  design.seed = std::isfinite(seed) ? static_cast<std::uint64_t>(seed) : 0;
  design.subjects = std::isfinite(subjects) ? static_cast<std::int64_t>(subjects) : 1;
  if (design.experiment.empty() == design.plan.empty())
    faults.add(root, "experiment", "needs exactly one of experiment and plan", "one of the two");
  if (!design.plan.empty() && root.find("trials") != nullptr)
    faults.add(*root.find("trials"), "trials", "a plan says how many", "none beside a plan");
  for (const VariedKey& axis : design.axes) {
    const auto refuse = [&](const char* what, const char* allowed) {
      faults.add(*root.find("vary")->find(axis.path), "vary." + axis.path, what, allowed);
    };
    if (!design.plan.empty() && (axis.path == "experiment" || axis.path == "trials"))
      refuse("stands beside a plan, which has its own", "plan.KEY");
    if (design.plan.empty() && axis.path.starts_with("plan.")) refuse("is of a plan, and this study has none", "a key of the experiment");
  }
  for (const Fault& fault : measureProblems(design)) faults.addOfValue(root, fault);
  if (named) {
    design.plan = named->planFile;
    design.planText = named->plan;
    design.experimentTexts = named->experiments;
    design.definitionTexts = named->definitions;
  } else {
    readExperiments(root, design, faults);
  }
  faults.throwIfAny();
  double points = static_cast<double>(design.samples);
  for (const VariedKey& axis : design.axes)
    if (!axis.uniform) points *= static_cast<double>(axis.values.size());
  if (!(points <= static_cast<double>(kMaxPoints)))
    faults.add(root, "vary", fmt::format("makes {:.0f} points", points), fmt::format("up to {}", kMaxPoints));
  faults.throwIfAny();
  return design;
}

Design readDesign(const std::string& file) { return parseDesign(readTextFile(file), file); }

}  // namespace reachlab::study
