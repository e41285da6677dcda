#include "cli/terminal/analysis_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>

#include "base/as_number.h"
#include "base/json/json_reader.h"
#include "sim/record/log/whole_file.h"
#include "sim/session/backup.h"

namespace reachlab::cli {
namespace {

// The options of `reach analyze` that change numbers or choose what is compared.
constexpr std::array<std::string_view, 14> kPlanned{
    "criterion",     "hand-mass",   "hand-damping", "hand-masses",  "prediction-duration", "onset",
    "onset-percent", "onset-speed", "cutoff",       "learning-bin", "include-practice",    "recovery",
    "seed",          "experiment"};

bool isDate(const std::string& text) {
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
  const auto year = asNumber<int>(text.substr(0, 4));
  const auto month = asNumber<unsigned>(text.substr(5, 2)), day = asNumber<unsigned>(text.substr(8));
  return year && month && day &&
         std::chrono::year_month_day(std::chrono::year(*year), std::chrono::month(*month), std::chrono::day(*day)).ok();
}

std::string valueOf(const JsonNode& node) {
  switch (node.kind) {
    case JsonNode::Kind::String: return node.string;
    case JsonNode::Kind::Number: return node.integer ? fmt::format("{:.0f}", node.number) : fmt::format("{}", node.number);
    case JsonNode::Kind::Boolean: return node.boolean ? "true" : "false";
    default: return {};
  }
}

}  // namespace

AnalysisPlan readAnalysisPlan(const std::string& file) {
  AnalysisPlan plan;
  plan.file = file;
  const std::string text = record::readWholeFile(file);
  plan.sha256 = session::sha256Of(text);
  const JsonNode root = parseJson(text, file);
  FaultList faults(file);
  ObjectReader reader(faults, root, "");
  int version = 0;
  if (reader.required("schema_version", "1") != nullptr) reader.integer("schema_version", 1, 1, version);
  if (reader.required("date", "the day of the plan: \"2026-11-25\"") != nullptr) {
    reader.text("date", plan.date);
    if (!plan.date.empty() && !isDate(plan.date)) faults.add(*root.find("date"), "date", "is " + plan.date, "a day: \"2026-11-25\"");
  }
  if (const JsonNode* options = reader.required("options", "options of `reach analyze` without dashes: { \"cutoff\": 10 }");
      options != nullptr) {
    if (options->kind != JsonNode::Kind::Object) faults.add(*options, "options", "is no object", "options with their values");
    for (const auto& [name, node] : options->members) {
      const std::string key = "options." + name;
      if (std::find(kPlanned.begin(), kPlanned.end(), name) == kPlanned.end())
        faults.add(node, key, "is no option that changes numbers", fmt::format("{}", fmt::join(kPlanned, ", ")));
      AnalysisPlan::Option option{name, {}, FilePlace{file, node.keyLine, node.keyColumn}};
      const bool list = node.kind == JsonNode::Kind::Array;
      for (const JsonNode& value : list ? node.items : std::vector<JsonNode>{node}) {
        option.values.push_back(valueOf(value));
        if (option.values.back().empty()) faults.add(value, key, "is no value", "a number, a text, or true");
      }
      plan.options.push_back(std::move(option));
    }
  }
  reader.finish();
  faults.throwIfAny();
  return plan;
}

void applyPlan(CLI::App& command, AnalysisPlan& plan) {
  for (const std::string_view name : kPlanned) {
    CLI::Option* option = command.get_option("--" + std::string(name));
    const auto planned = std::find_if(plan.options.begin(), plan.options.end(), [&](const auto& o) { return o.name == name; });
    const std::string given = fmt::format("{}", fmt::join(option->results(), " "));
    if (planned == plan.options.end()) {
      if (option->count() > 0) plan.departures.push_back(fmt::format("--{} {} is not in the plan.", name, given));
      continue;
    }
    const std::string wanted = fmt::format("{}", fmt::join(planned->values, " "));
    if (option->count() > 0) {
      if (given != wanted) plan.departures.push_back(fmt::format("--{} is {}, and the plan says {}.", name, given, wanted));
      continue;
    }
    try {
      for (const std::string& value : planned->values) option->add_result(value);
      option->run_callback();
    } catch (const CLI::Error& error) {
      throw FaultError(Fault{"options." + planned->name, fmt::format("is {}: {}", wanted, error.what()), {}, planned->place});
    }
  }
}

void checkDate(AnalysisPlan& plan, const std::vector<std::string>& startedUtc) {
  std::string first;
  for (const std::string& start : startedUtc)
    if (start.size() >= 10 && isDate(start.substr(0, 10)) && (first.empty() || start < first)) first = start.substr(0, 10);
  if (first.empty()) plan.departures.push_back("The recordings have no date, so the plan may be younger than the data.");
  else if (plan.date >= first)
    plan.departures.push_back(
        fmt::format("The plan is of {}, and the first recording is of {}: it was not written before the data.", plan.date, first));
}

}  // namespace reachlab::cli
