#include "sim/session/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/json_reader.h"
#include "sim/experiment/experiment.h"
#include "sim/trial/task_check.h"

namespace reachlab::session {
namespace {

namespace fs = std::filesystem;

void readForeperiod(ObjectReader& reader, PlanBlock& block) {
  const JsonNode* node = reader.optional("foreperiod_s");
  std::vector<double> range;
  if (node == nullptr || !reader.numbers(*node, "foreperiod_s", 2, atLeastZero("s"), range)) return;
  if (range[0] > range[1] || range[1] > 60)
    reader.faults().add(*node, reader.keyPath("foreperiod_s"), "is no range", "[from, to] in s, from <= to <= 60");
  block.foreperiodMin = range[0];
  block.foreperiodMax = range[1];
}

// The settings that may stand for the whole plan or for one block.
void readSettings(ObjectReader& reader, PlanBlock& block) {
  reader.integer("trials", 1, 1000000, block.trials);
  reader.boolean("practice", block.practice);
  reader.number("pause_s", atLeastZero("s"), block.pauseSeconds);
  reader.number("catch_share", {0, 0.5, true, "a share from 0 to 0.5"}, block.catchShare);
  reader.boolean("repeat_aborted", block.repeatAborted);
  readForeperiod(reader, block);
}

std::string besidePlan(const std::string& planFile, const std::string& experiment) {
  const fs::path beside = fs::path(planFile).parent_path() / experiment;
  std::error_code error;
  return fs::is_regular_file(beside, error) ? beside.string() : experiment;
}

void readBlock(ObjectReader& plan, const JsonNode& node, std::size_t index, const std::string& file, PlanBlock block, Plan& out) {
  ObjectReader reader(plan.faults(), node, fmt::format("blocks[{}]", index));
  if (reader.required("experiment", "a file, or the name of a shipped experiment") != nullptr) {
    reader.text("experiment", block.experiment);
    block.experiment = besidePlan(file, block.experiment);
  }
  if (plan.node().find("trials") == nullptr) static_cast<void>(reader.required("trials", "a whole number from 1"));
  readSettings(reader, block);
  reader.text("condition", block.condition);
  reader.integer("day", 1, 10000, block.day);
  reader.finish();
  out.blocks.push_back(block);
}

void readOrderSeed(ObjectReader& reader, Plan& plan) {
  double seed = 0;  // a JSON number is read as a double: whole up to 2^53
  const NumberRange range = wholeNumber(0, 9007199254740992.0);
  reader.number("order_seed", range, seed);
  if (seed != std::floor(seed))
    reader.faults().add(*reader.optional("order_seed"), "order_seed", fmt::format("is {}", seed), range.allowed);
  plan.orderSeed = static_cast<std::uint64_t>(seed);
}

}  // namespace

bool isPlan(const std::string& text, const std::string& file) { return parseJson(text, file).find("blocks") != nullptr; }

std::optional<std::string> findPlan(const std::string& fileOrName) {
  std::error_code error;
  if (fs::exists(fileOrName, error)) return fileOrName;
  const bool plainName = fileOrName.find('/') == std::string::npos;
  const std::string shipped = fmt::format("{}/plans/{}.json", experiment::resourceFolder(), fileOrName);
  if (plainName && fs::is_regular_file(shipped, error)) return shipped;
  return std::nullopt;
}

Plan parsePlan(const std::string& text, const std::string& file) {
  const JsonNode root = parseJson(text, file);
  FaultList faults(file);
  Plan plan;
  plan.name = fs::path(file).stem().string();
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
    if (blocks->kind != JsonNode::Kind::Array || blocks->items.empty())
      faults.add(*blocks, "blocks", blocks->kind == JsonNode::Kind::Array ? "is empty" : "is no array", "an array of blocks");
    for (std::size_t i = 0; i < blocks->items.size(); ++i) readBlock(reader, blocks->items[i], i, file, defaults, plan);
  }
  reader.finish();
  faults.throwIfAny();
  return plan;
}

Plan readPlan(const std::string& file) { return parsePlan(readTextFile(file), file); }

std::vector<std::string> planProblems(const std::string& file) {
  std::vector<std::string> found;
  Plan plan;
  try {
    plan = readPlan(file);
  } catch (const UsageError& error) {
    found.emplace_back(error.what());
    return found;
  }
  std::vector<std::string> seen;
  for (const PlanBlock& block : plan.blocks) {
    if (std::find(seen.begin(), seen.end(), block.experiment) != seen.end()) continue;
    seen.push_back(block.experiment);
    try {
      trial::checkTask(experiment::readExperiment(block.experiment), file + ": blocks: " + block.experiment);
    } catch (const UsageError& error) {
      found.emplace_back(error.what());
    }
  }
  return found;
}

}  // namespace reachlab::session
