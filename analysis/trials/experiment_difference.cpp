#include "analysis/trials/experiment_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/experiment/experiment.h"
#include "sim/experiment/unit_ending.h"

namespace reachlab::analysis {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kMaxValueLength = 40;  // characters; a longer one would drown the sentence it stands in

struct KeyWords {
  std::string name, unit;
};

KeyWords wordsOf(const std::string& key) {
  const experiment::NamedQuantity quantity = experiment::splitUnit(key);
  KeyWords words{std::string(quantity.name), std::string(quantity.unit)};
  std::replace(words.name.begin(), words.name.end(), '_', ' ');
  if (words.unit.ends_with("^2")) words.unit.replace(words.unit.size() - 2, 2, "²");
  return words;
}

std::string textOf(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_array()) return value.dump();
  if (value.size() > 2 && std::all_of(value.begin(), value.end(), [&](const Json& v) { return v == value.front(); }))
    return fmt::format("{} x {}", value.size(), textOf(value.front()));
  std::vector<std::string> parts;
  for (const Json& part : value) parts.push_back(textOf(part));
  return fmt::format("{}", fmt::join(parts, " "));
}

std::string sentenceOf(const std::string& group, const std::string& key, const Json* value) {
  const KeyWords words = wordsOf(key);
  const std::string name = group.empty() ? words.name : group + " " + words.name;
  if (value == nullptr) return "no " + name;
  const std::string text = textOf(*value);
  if (text.size() > kMaxValueLength) return "another " + name;
  return fmt::format("{} {}{}{}", name, text, words.unit.empty() ? "" : " ", words.unit);
}

// `object` and `task` go without saying, and a shape is its constraint's.
std::string groupWithin(const std::string& group, const std::string& key) {
  if (key == "object" || key == "task" || key == "shape") return group;
  return group.empty() ? wordsOf(key).name : group + " " + wordsOf(key).name;
}

void compare(const std::string& group, const Json& first, const Json& other, std::vector<std::string>& found) {
  for (const auto& [key, value] : other.items()) {
    const auto before = first.find(key);
    if (before != first.end() && *before == value) continue;
    if (value.is_object()) compare(groupWithin(group, key), before == first.end() ? Json::object() : *before, value, found);
    else found.push_back(sentenceOf(group, key, &value));
  }
  for (const auto& [key, value] : first.items())
    if (!other.contains(key)) found.push_back(sentenceOf(group, key, nullptr));
}

}  // namespace

std::vector<std::string> differences(const experiment::Experiment& first, const experiment::Experiment& other) {
  std::vector<std::string> found;
  compare({}, Json::parse(experiment::toJson(first)), Json::parse(experiment::toJson(other)), found);
  const std::string &before = first.constraint.definition, &now = other.constraint.definition;  // empty: the catalogue's
  if (found.empty() && !before.empty() && !now.empty() && before != now) found.push_back("another definition of " + other.constraint.name);
  return found;
}

std::vector<std::string> differencesBesideDirection(const experiment::Experiment& first, const experiment::Experiment& other) {
  experiment::Experiment turned = other;
  turned.task->start = first.task->start;
  turned.task->target = first.task->target;
  return differences(first, turned);
}

bool differInDirectionOnly(const experiment::Experiment& first, const experiment::Experiment& other) {
  constexpr double kRounding = 1e-9;  // [m] a ring's targets are rounded to 1e-12
  const auto isFree = [](const experiment::Experiment& e) {
    return e.constraint.name == "free" && e.task && (e.object.kind == experiment::ObjectKind::None || e.object.gravity == Vec3{});
  };
  if (!isFree(first) || !isFree(other)) return false;
  const auto distance = [](const experiment::Task& task) {
    return std::hypot(task.target[0] - task.start[0], task.target[1] - task.start[1], task.target[2] - task.start[2]);
  };
  if (std::abs(distance(*first.task) - distance(*other.task)) > kRounding) return false;
  return differencesBesideDirection(first, other).empty();
}

}  // namespace reachlab::analysis
