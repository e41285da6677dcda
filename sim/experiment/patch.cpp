#include "sim/experiment/patch.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/as_number.h"
#include "base/fault.h"

namespace reachlab::experiment {
namespace {

using Json = nlohmann::ordered_json;

struct Step {
  std::string key;                // of an object; empty: an element
  std::optional<std::size_t> at;  // of an array; none: every one
};

std::vector<Step> stepsOf(const std::string& path) {
  const auto refuse = [&](const std::string& what) { throw FaultError(Fault{path, what, "as in object.masses_kg[0] or task.duration_s"}); };
  std::vector<Step> steps;
  std::size_t at = 0;
  while (at < path.size()) {
    if (path[at] == '[') {
      const std::size_t close = path.find(']', at);
      if (close == std::string::npos) refuse("has a [ without ]");
      const std::string inside = path.substr(at + 1, close - at - 1);
      Step step;
      if (inside != "*") {
        step.at = asNumber<std::size_t>(inside);
        if (!step.at) refuse(fmt::format("has no number in [{}]", inside));
      }
      steps.push_back(step);
      at = close + 1;
      if (at < path.size() && path[at] == '.') ++at;
      continue;
    }
    const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    if (end == at) refuse("has an empty key");
    steps.push_back({path.substr(at, end - at), std::nullopt});
    at = end + (end < path.size() && path[end] == '.');
  }
  if (steps.empty() || path.back() == '.') refuse("has an empty key");
  return steps;
}

void put(Json& node, std::span<const Step> steps, const Json& value, const std::string& path) {
  if (steps.empty()) {
    node = value;
    return;
  }
  const Step& step = steps.front();
  if (!step.key.empty()) {
    if (node.is_null()) node = Json::object();
    if (!node.is_object()) throw FaultError(Fault{path, fmt::format("looks for {} in what is no object", step.key), "keys of the file"});
    return put(node[step.key], steps.subspan(1), value, path);
  }
  if (!node.is_array()) throw FaultError(Fault{path, "looks for an element of what is no array", "keys of the file"});
  if (step.at && *step.at >= node.size())
    throw FaultError(Fault{path, fmt::format("is beyond the {} elements that are there", node.size()), "an element that is there, from 0"});
  if (node.empty()) throw FaultError(Fault{path, "changes nothing: the list is empty", "elements that are there"});
  for (std::size_t i = 0; i < node.size(); ++i)
    if (!step.at || *step.at == i) put(node[i], steps.subspan(1), value, path);
}

}  // namespace

bool nameOneValue(const std::string& one, const std::string& other) try {
  const std::vector<Step> a = stepsOf(one), b = stepsOf(other);
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (a[i].key != b[i].key || (a[i].at && b[i].at && *a[i].at != *b[i].at)) return false;
  return true;
} catch (const FaultError&) {
  return false;
}

std::string valueText(const JsonNode& node) {
  switch (node.kind) {
    case JsonNode::Kind::Null: return "null";
    case JsonNode::Kind::Boolean: return node.boolean ? "true" : "false";
    case JsonNode::Kind::Number: return fmt::format("{}", node.number);
    case JsonNode::Kind::String: return Json(node.string).dump();
    case JsonNode::Kind::Array: {
      std::string text = "[";
      for (const JsonNode& item : node.items) text += (text.size() > 1 ? "," : "") + valueText(item);
      return text + "]";
    }
    case JsonNode::Kind::Object: break;
  }
  std::string text = "{";
  for (const auto& [key, value] : node.members)
    text += fmt::format("{}{}:{}", text.size() > 1 ? "," : "", Json(key).dump(), valueText(value));
  return text + "}";
}

std::vector<Patch> readPatches(const JsonNode& node, const std::string& key, FaultList& faults) {
  std::vector<Patch> patches;
  if (node.kind != JsonNode::Kind::Object) faults.add(node, key, "is no object", "keys of the experiment with their values");
  for (const auto& [path, value] : node.members) patches.push_back({path, valueText(value)});
  return patches;
}

std::string patchedText(const std::string& text, const std::string& file, std::span<const Patch> patches) {
  static_cast<void>(parseJson(text, file));  // faults with their places
  Json tree = Json::parse(text, nullptr, true, true);
  for (const Patch& patch : patches) put(tree, stepsOf(patch.path), Json::parse(patch.value, nullptr, true, true), patch.path);
  return tree.dump(2) + "\n";
}

}  // namespace reachlab::experiment
