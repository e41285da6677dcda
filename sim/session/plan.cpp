#include "sim/session/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json/json_reader.h"
#include "base/names.h"
#include "base/text_file.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::session {
namespace {

constexpr std::size_t kMaxBlocks = 1000, kMaxCondition = 100;  // a condition is part of the names of the analysis's files

void readForeperiod(ObjectReader& reader, PlanBlock& block) {
  const JsonNode* node = reader.optional("foreperiod_s");
  std::vector<double> range;
  if (node == nullptr || !reader.numbers(*node, "foreperiod_s", 2, anyNumber(), range)) return;
  block.foreperiodMin = range[0];
  block.foreperiodMax = range[1];
}

// The settings that may stand for the whole plan or for one block.
void readSettings(ObjectReader& reader, PlanBlock& block) {
  reader.integer("trials", 1, kMaxTrials, block.trials);
  reader.boolean("practice", block.practice);
  reader.number("pause_s", anyNumber(), block.pauseSeconds);
  reader.number("catch_share", anyNumber(), block.catchShare);
  reader.boolean("repeat_aborted", block.repeatAborted);
  reader.number("rest_s", anyNumber(), block.restSeconds);
  readForeperiod(reader, block);
  readMix(reader, block.mix);
}

void readBlock(ObjectReader& plan, const JsonNode& node, std::size_t index, const std::string& file, PlanBlock block, Plan& out) {
  ObjectReader reader(plan.faults(), node, fmt::format("blocks[{}]", index));
  if (reader.required("experiment", "a file, or the name of a shipped experiment") != nullptr) {
    reader.text("experiment", block.experiment);
    block.experiment = besideFile(file, block.experiment);
  }
  if (const JsonNode* change = reader.optional("change"))
    block.changes = experiment::readPatches(*change, reader.keyPath("change"), plan.faults());
  if (plan.node().find("trials") == nullptr) static_cast<void>(reader.required("trials", "a whole number from 1"));
  readSettings(reader, block);
  reader.text("condition", block.condition);
  reader.text("instructions", block.instructions);
  reader.integer("day", 1, kMaxDay, block.day);
  reader.finish();
  out.blocks.push_back(block);
}

void readOrderSeed(ObjectReader& reader, Plan& plan) {
  double seed = 0;
  reader.number("order_seed", wholeNumber(0, kMaxOrderSeed), seed);
  plan.orderSeed = static_cast<std::uint64_t>(seed);
}

void checkBlock(const std::string& key, const PlanBlock& block, std::vector<Fault>& faults) {
  if (block.experiment.empty()) faults.push_back({key + ".experiment", "is empty", "a file, or the name of a shipped experiment"});
  if (!block.changes.empty() && block.condition.empty())
    faults.push_back({key + ".condition", "is missing where the experiment is changed", "a name that tells these trials from the others"});
  if (block.condition.size() > kMaxCondition)
    faults.push_back({key + ".condition", fmt::format("has {} bytes", block.condition.size()), fmt::format("up to {}", kMaxCondition)});
  checkNumber(key + ".trials", block.trials, wholeNumber(1, kMaxTrials), faults);
  const NumberRange pause{0, kMaxPause, true, fmt::format("0 to {:g} s", kMaxPause)};
  checkNumber(key + ".pause_s", block.pauseSeconds, pause, faults);
  checkNumber(key + ".rest_s", block.restSeconds, pause, faults);
  checkNumber(key + ".catch_share", block.catchShare, {0, kMaxCatchShare, true, fmt::format("a share from 0 to {:g}", kMaxCatchShare)},
              faults);
  if (block.day != 0) checkNumber(key + ".day", block.day, wholeNumber(1, kMaxDay), faults);
  const std::vector<Fault> ofMix = problems(block.mix, block.trials, key);
  faults.insert(faults.end(), ofMix.begin(), ofMix.end());
  if (block.catchShare > 0 && block.catchShare <= kMaxCatchShare && (block.trials < 2 || std::lround(block.catchShare * block.trials) == 0))
    faults.push_back(
        {key + ".catch_share", fmt::format("is {} of the {} trials of a block, which is no trial", block.catchShare, block.trials),
         block.trials < 2 ? "0 in a block of one trial" : fmt::format("0 in that block, or {:.3g} and more", 0.5 / block.trials)});
  if (block.mix.wayBack && block.catchShare > 0)
    faults.push_back({key + ".return", "is reach, and a catch trial has no way back", "free, or a catch_share of 0"});
  if (!(block.foreperiodMin >= 0 && block.foreperiodMin <= block.foreperiodMax && block.foreperiodMax <= kMaxForeperiod))
    faults.push_back({key + ".foreperiod_s", "is no range", fmt::format("[from, to] in s, 0 <= from <= to <= {:g}", kMaxForeperiod)});
}

// What the file gives for the plan as a whole is told once, where it stands.
void addProblems(const JsonNode& root, const Plan& plan, FaultList& faults) {
  std::vector<Fault> told;
  for (Fault fault : problems(plan)) {
    if (const std::size_t dot = fault.key.find("]."); dot != std::string::npos)
      fault.key =
          keyInPlan(root, static_cast<std::size_t>(std::stoul(fault.key.substr(fault.key.find('[') + 1))), fault.key.substr(dot + 2));
    if (std::find(told.begin(), told.end(), fault) != told.end()) continue;
    told.push_back(fault);
    faults.addOfValue(root, std::move(fault));
  }
}

}  // namespace

std::string keyInPlan(const JsonNode& root, std::size_t block, const std::string& setting) {
  const std::string own = setting.substr(0, setting.find_first_of(".["));  // "mix" of "mix[0].count"
  const bool ofPlan = root.find(own) != nullptr && root.find("blocks")->items.at(block).find(own) == nullptr;
  return ofPlan ? setting : fmt::format("blocks[{}].{}", block, setting);
}

std::string conditionOf(const PlanBlock& block) { return block.condition.empty() ? nameOfFile(block.experiment) : block.condition; }

experiment::CompiledExperiment openExperimentOf(const PlanBlock& block) {
  experiment::CompiledExperiment plain = experiment::openExperiment(block.experiment);
  if (block.changes.empty()) return plain;
  return underKey("change", [&] {
    return experiment::openExperimentText(experiment::patchedText(plain.experiment().text, block.experiment, block.changes),
                                          block.experiment);
  });
}

bool isPlan(const std::string& text, const std::string& file) { return parseJson(text, file).find("blocks") != nullptr; }

std::optional<std::string> findPlan(const std::string& fileOrName) {
  if (isThere(fileOrName) && !isFolder(fileOrName)) return fileOrName;
  const bool plainName = fileOrName.find('/') == std::string::npos;
  const std::string shipped = fmt::format("{}/plans/{}.json", experiment::resourceFolder(), fileOrName);
  if (plainName && isFile(shipped)) return shipped;
  return std::nullopt;
}

std::vector<std::string> shippedPlans() { return experiment::shippedNames("plans"); }

Plan parsePlan(const std::string& text, const std::string& file) {
  const JsonNode root = parseJson(text, file);
  FaultList faults(file);
  Plan plan;
  plan.name = nameOfFile(file);
  plan.text = text;
  ObjectReader reader(faults, root, "");
  double version = 1;
  reader.requiredNumber("schema_version", {1, 1, true, "1, the version that this program reads"}, version);
  reader.text("name", plan.name);
  readOrderSeed(reader, plan);
  std::string counterbalance = "none";
  reader.choice("counterbalance", {"none", "permute"}, counterbalance, false);
  plan.counterbalance = counterbalance == "permute" ? Counterbalance::Permute : Counterbalance::None;
  PlanBlock defaults;
  readSettings(reader, defaults);
  if (const JsonNode* blocks = reader.required("blocks", "an array of blocks")) {
    if (blocks->kind != JsonNode::Kind::Array) faults.add(*blocks, "blocks", "is no array", "an array of blocks");
    for (std::size_t i = 0; i < blocks->items.size(); ++i) readBlock(reader, blocks->items[i], i, file, defaults, plan);
  }
  reader.finish();
  addProblems(root, plan, faults);
  faults.throwIfAny();
  return plan;
}

std::vector<Fault> problems(const Plan& plan) {
  std::vector<Fault> faults;
  if (plan.blocks.empty()) faults.push_back({"blocks", "is empty", "an array of blocks"});
  if (plan.blocks.size() > kMaxBlocks)
    return {{"blocks", fmt::format("has {} blocks", plan.blocks.size()), fmt::format("up to {}", kMaxBlocks)}};
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) checkBlock(fmt::format("blocks[{}]", i), plan.blocks[i], faults);
  return faults;
}

std::string toJson(const Plan& plan) {
  using Json = nlohmann::ordered_json;
  const PlanBlock plain;
  Json blocks = Json::array();
  for (const PlanBlock& b : plan.blocks) {
    Json block{{"experiment", b.experiment}, {"trials", b.trials}};
    for (const experiment::Patch& change : b.changes) block["change"][change.path] = Json::parse(change.value);
    const auto put = [&](const char* key, const auto& value, const auto& usual) {
      if (value != usual) block[key] = value;
    };
    put("condition", b.condition, plain.condition);
    put("day", b.day, plain.day);
    put("practice", b.practice, plain.practice);
    put("pause_s", b.pauseSeconds, plain.pauseSeconds);
    if (b.foreperiodMin != 0 || b.foreperiodMax != 0) block["foreperiod_s"] = {b.foreperiodMin, b.foreperiodMax};
    put("catch_share", b.catchShare, plain.catchShare);
    put("repeat_aborted", b.repeatAborted, plain.repeatAborted);
    put("rest_s", b.restSeconds, plain.restSeconds);
    put("instructions", b.instructions, plain.instructions);
    writeMix(block, b.mix);
    blocks.push_back(std::move(block));
  }
  Json root{{"schema_version", 1}, {"name", plan.name}, {"order_seed", plan.orderSeed}};
  root["counterbalance"] = plan.counterbalance == Counterbalance::Permute ? "permute" : "none";
  root["blocks"] = std::move(blocks);
  return root.dump(2) + "\n";
}

Plan readPlan(const std::string& file) { return parsePlan(readTextFile(file), file); }

}  // namespace reachlab::session
