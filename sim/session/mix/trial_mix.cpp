#include "sim/session/mix/trial_mix.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "sim/session/mix/mix_order.h"

namespace reachlab::session {
namespace {

constexpr int kMaxCount = 100'000, kMaxTargets = 360;
constexpr std::size_t kMaxScenes = 2000;
constexpr std::size_t kMaxName = 40;

NumberRange ringRadius() { return positiveUpTo(10, "m"); }
NumberRange ringAngle() { return {-360, 360, true, "-360 to 360 degrees"}; }

bool isKindName(const std::string& name) {
  return !name.empty() && name.size() <= kMaxName &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) { return c < 128 && (std::isalnum(c) || c == '-' || c == '_'); });
}

// `known` is empty where the block has no kinds.
void checkKnown(const std::string& key, const std::string& name, const std::vector<std::string>& known, const char* what,
                std::vector<Fault>& faults) {
  if (std::find(known.begin(), known.end(), name) == known.end())
    faults.push_back({key, fmt::format("is \"{}\", which is no kind of {}", name, what),
                      known.empty() ? "none, since the block has no kinds" : fmt::format("{}", fmt::join(known, ", "))});
}

std::string nearestMultiples(int trials, int of) {
  const int below = trials / of * of;
  return below == 0 ? fmt::format("a multiple of {}, such as {}", of, of)
                    : fmt::format("a multiple of {}, such as {} or {}", of, below, below + of);
}

}  // namespace

const std::vector<std::string>& trialOrderNames() {
  static const std::vector<std::string> kNames{"as-written", "shuffled-cycles", "shuffled"};
  return kNames;
}

std::vector<KindCount> cycleOf(const TrialMix& mix) {
  if (!mix.cycle.empty()) return mix.cycle;
  std::vector<KindCount> cycle;
  for (const TrialKind& kind : mix.kinds) cycle.push_back({kind.name, 1});
  return cycle;
}

std::vector<std::string> kindsInUse(const TrialMix& mix) {
  if (mix.kinds.empty()) return {""};
  std::vector<std::string> kinds;
  for (const KindCount& some : cycleOf(mix))
    if (std::find(kinds.begin(), kinds.end(), some.kind) == kinds.end()) kinds.push_back(some.kind);
  return kinds;
}

namespace {

void readKinds(ObjectReader& reader, const JsonNode& node, TrialMix& mix) {
  mix.kinds.clear();
  if (node.kind != JsonNode::Kind::Object)
    return reader.faults().add(node, reader.keyPath("kinds"), "is no object", "{ NAME: { PATH: value, … }, … }");
  for (const auto& [name, changes] : node.members)
    mix.kinds.push_back({name, experiment::readPatches(changes, reader.keyPath("kinds") + "." + name, reader.faults())});
}

void readCycle(ObjectReader& reader, const JsonNode& node, TrialMix& mix) {
  mix.cycle.clear();
  if (node.kind != JsonNode::Kind::Array || node.items.empty())
    return reader.faults().add(node, reader.keyPath("mix"), "is no list of kinds", "[{ \"kind\": NAME, \"count\": N }, …]");
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    ObjectReader one(reader.faults(), node.items[i], reader.keyPath(fmt::format("mix[{}]", i)));
    KindCount some;
    if (one.required("kind", "the name of a kind") != nullptr) one.text("kind", some.kind);
    one.integer("count", 1, kMaxCount, some.count);
    one.finish();
    mix.cycle.push_back(std::move(some));
  }
}

void readNames(ObjectReader& reader, const char* key, std::vector<std::string>& names) {
  if (const JsonNode* node = reader.optional(key)) (void)reader.strings(*node, key, static_cast<int>(node->items.size()), names);
}

void readTargets(ObjectReader& reader, const JsonNode& node, TrialMix& mix) {
  mix.ring.reset();
  mix.targets.clear();
  const std::string key = reader.keyPath("targets");
  if (node.kind == JsonNode::Kind::Array) {
    if (node.items.empty()) reader.faults().add(node, key, "is empty", "a list of places, or a ring");
    for (std::size_t i = 0; i < node.items.size(); ++i)
      (void)reader.numbers(node.items[i], fmt::format("targets[{}]", i), -1, anyNumber(), mix.targets.emplace_back());
    return;
  }
  ObjectReader targets(reader.faults(), node, key);
  if (const JsonNode* ring = targets.required("ring", "{ \"count\": 8, \"radius_m\": 0.1 }")) {
    ObjectReader one(reader.faults(), *ring, targets.keyPath("ring"));
    TargetRing& r = mix.ring.emplace();
    one.integer("count", 1, kMaxTargets, r.count);
    one.number("radius_m", ringRadius(), r.radius);
    one.number("first_deg", ringAngle(), r.firstDegrees);
    one.finish();
  }
  targets.finish();
}

}  // namespace

void readMix(ObjectReader& reader, TrialMix& mix) {
  if (const JsonNode* kinds = reader.optional("kinds")) readKinds(reader, *kinds, mix);
  if (const JsonNode* cycle = reader.optional("mix")) readCycle(reader, *cycle, mix);
  if (const JsonNode* targets = reader.optional("targets")) readTargets(reader, *targets, mix);
  std::string order = trialOrderNames()[static_cast<std::size_t>(mix.order)], back = mix.wayBack ? "reach" : "free";
  if (reader.choice("order", trialOrderNames(), order, false))
    mix.order = static_cast<TrialOrder>(std::find(trialOrderNames().begin(), trialOrderNames().end(), order) - trialOrderNames().begin());
  readNames(reader, "not_first", mix.notFirst);
  readNames(reader, "not_twice", mix.notTwice);
  if (reader.choice("return", {"free", "reach"}, back, false)) mix.wayBack = back == "reach";
}

void writeMix(nlohmann::ordered_json& block, const TrialMix& mix) {
  using Json = nlohmann::ordered_json;
  for (const TrialKind& kind : mix.kinds) {
    Json& changes = block["kinds"][kind.name] = Json::object();
    for (const experiment::Patch& change : kind.changes) changes[change.path] = Json::parse(change.value);
  }
  for (const KindCount& some : mix.cycle) block["mix"].push_back({{"kind", some.kind}, {"count", some.count}});
  if (mix.ring)
    block["targets"]["ring"] = {{"count", mix.ring->count}, {"radius_m", mix.ring->radius}, {"first_deg", mix.ring->firstDegrees}};
  else if (!mix.targets.empty()) block["targets"] = mix.targets;
  if (mix.order != TrialOrder::AsWritten) block["order"] = trialOrderNames()[static_cast<std::size_t>(mix.order)];
  if (!mix.notFirst.empty()) block["not_first"] = mix.notFirst;
  if (!mix.notTwice.empty()) block["not_twice"] = mix.notTwice;
  if (mix.wayBack) block["return"] = "reach";
}

std::vector<Fault> problems(const TrialMix& mix, int trials, const std::string& prefix) {
  std::vector<Fault> faults;
  const std::string key = prefix.empty() ? "" : prefix + ".";
  // Before anything is compared with everything else, and before counts are added.
  for (const auto& [list, length] : {std::pair{"kinds", mix.kinds.size()},
                                     {"mix", mix.cycle.size()},
                                     {"targets", mix.targets.size()},
                                     {"not_first", mix.notFirst.size()},
                                     {"not_twice", mix.notTwice.size()}})
    if (length > kMaxScenes) faults.push_back({key + list, fmt::format("has {} entries", length), fmt::format("{} at most", kMaxScenes)});
  if (!faults.empty()) return faults;
  for (const TrialKind& kind : mix.kinds)
    if (!isKindName(kind.name))
      faults.push_back({key + "kinds." + kind.name, "is no name of a kind", fmt::format("up to {} letters, digits, - and _", kMaxName)});
  std::vector<std::string> known;
  for (const TrialKind& kind : mix.kinds) known.push_back(kind.name);
  for (std::size_t i = 0; i < mix.cycle.size(); ++i) {
    checkKnown(fmt::format("{}mix[{}].kind", key, i), mix.cycle[i].kind, known, "this block", faults);
    checkNumber(fmt::format("{}mix[{}].count", key, i), mix.cycle[i].count, wholeNumber(1, kMaxCount), faults);
  }
  if (!known.empty()) known = kindsInUse(mix);
  for (const auto& [list, names] : {std::pair{"not_first", &mix.notFirst}, {"not_twice", &mix.notTwice}})
    for (std::size_t i = 0; i < names->size(); ++i)
      checkKnown(fmt::format("{}{}[{}]", key, list, i), (*names)[i], known, "this block's mix", faults);
  for (std::size_t i = 0; i < mix.targets.size(); ++i) {
    const std::vector<double>& target = mix.targets[i];
    const std::string which = fmt::format("{}targets[{}]", key, i);
    if (target.empty() || target.size() != mix.targets.front().size())
      faults.push_back({which, fmt::format("has {} numbers", target.size()), "as many numbers as task.target has"});
    else if (const auto same = std::find(mix.targets.begin(), mix.targets.begin() + static_cast<std::ptrdiff_t>(i), target);
             same != mix.targets.begin() + static_cast<std::ptrdiff_t>(i))
      faults.push_back({which, fmt::format("is target {} again", same - mix.targets.begin() + 1), "each target once"});
  }
  if (mix.ring) {
    checkNumber(key + "targets.ring.count", mix.ring->count, wholeNumber(1, kMaxTargets), faults);
    checkNumber(key + "targets.ring.radius_m", mix.ring->radius, ringRadius(), faults);
    checkNumber(key + "targets.ring.first_deg", mix.ring->firstDegrees, ringAngle(), faults);
  }
  if (!faults.empty() || mix.isPlain() || trials < 1) return faults;
  if (const std::size_t scenes = static_cast<std::size_t>(mix.targetCount()) * kindsInUse(mix).size(); scenes > kMaxScenes)
    faults.push_back({key + "targets", fmt::format("makes {} scenes of kinds and targets", scenes), fmt::format("{} at most", kMaxScenes)});
  int length = 0;
  for (const KindCount& some : cycleOf(mix)) length += some.count;
  if (length > 0 && trials % length != 0)
    faults.push_back(
        {key + "trials", fmt::format("is {}, and a cycle of the mix has {} trials", trials, length), nearestMultiples(trials, length)});
  if (trials % mix.targetCount() != 0)
    faults.push_back({key + "trials", fmt::format("is {}, and there are {} targets", trials, mix.targetCount()),
                      nearestMultiples(trials, mix.targetCount())});
  if (!faults.empty()) return faults;
  if (const auto fault = orderFault(mix, trials)) faults.push_back({key + fault->key, fault->what, fault->allowed});
  return faults;
}

}  // namespace reachlab::session
