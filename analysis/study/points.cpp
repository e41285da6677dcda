#include "analysis/study/points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/json/json_tree.h"
#include "base/math/philox.h"
#include "base/math/seeded.h"

namespace reachlab::study {
namespace {

constexpr std::uint32_t kSubjectStream = 0, kSampleStream = 1;  // draws that have nothing to do with each other

PhiloxKey keyOf(const Design& design) {
  const std::uint64_t key = seededBits(hashOf(design.name), design.seed);
  return {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
}

std::uint64_t bitsOf(const PhiloxCounter& words) { return words[0] | static_cast<std::uint64_t>(words[1]) << 32; }

double fractionOf(const PhiloxCounter& words) { return static_cast<double>(bitsOf(words) >> 11) * 0x1.0p-53; }

// The part behind "plan.", if the path begins so.
std::optional<std::string> behind(const std::string& path, const char* prefix) {
  return path.starts_with(prefix) ? std::optional(path.substr(std::string_view(prefix).size())) : std::nullopt;
}

bool isOwn(const std::string& path) { return path == "experiment" || path == "trials"; }

std::vector<experiment::Patch> patchesOf(const Point& point, const char* prefix) {
  std::vector<experiment::Patch> patches;
  for (const experiment::Patch& patch : point.ofAxes) {
    if (*prefix == '\0') {
      if (!isOwn(patch.path) && !behind(patch.path, "subject.") && !behind(patch.path, "plan.")) patches.push_back(patch);
    } else if (const auto path = behind(patch.path, prefix)) {
      patches.push_back({*path, patch.value});
    }
  }
  return patches;
}

std::string deviceOf(const Design& design, const Point& point) {
  std::vector<std::pair<std::string, std::string>> options = design.subject;
  for (const experiment::Patch& patch : patchesOf(point, "subject.")) {
    const auto known = std::find_if(options.begin(), options.end(), [&](const auto& o) { return o.first == patch.path; });
    if (known == options.end()) options.emplace_back(patch.path, unquoted(patch.value));
    else known->second = unquoted(patch.value);
  }
  std::string device = "simulated";
  for (const auto& [key, value] : options) device += fmt::format("{}{}={}", device.size() == 9 ? ':' : ',', key, value);
  return device;
}

const experiment::Patch* findOwn(const Point& point, const char* path) {
  for (const experiment::Patch& patch : point.ofAxes)
    if (patch.path == path) return &patch;
  return nullptr;
}

std::vector<int> daysOf(const session::Plan& plan) {
  std::set<int> days;
  for (const session::PlanBlock& block : plan.blocks)
    if (block.day != 0) days.insert(block.day);
  if (days.empty()) return {0};
  return {days.begin(), days.end()};
}

session::Plan planOf(const Design& design, const Point& point) {
  const std::vector<experiment::Patch> changes = patchesOf(point, "plan.");
  return session::parsePlan(changes.empty() ? design.planText : experiment::patchedText(design.planText, design.plan, changes),
                            design.plan);
}

std::int64_t trialsOf(const session::Plan& plan) {
  std::int64_t trials = 0;
  for (const int day : daysOf(plan))
    for (const session::PlanBlock& block : plan.blocks)
      if (day == 0 || block.day == 0 || block.day == day) trials += block.trials * (block.mix.wayBack ? 2 : 1);
  return trials;
}

int trialsOf(const Design& design, const Point& point) {
  const experiment::Patch* patch = findOwn(point, "trials");
  if (patch == nullptr) return design.trials;
  const double trials = std::strtod(patch->value.c_str(), nullptr);
  if (!(trials >= 1 && trials <= 1'000'000) || trials != std::floor(trials))
    throw FaultError(Fault{"trials", "is " + patch->value, "a whole number from 1 to 1000000"});
  return static_cast<int>(trials);
}

/// Empty for a typed formula and free space.
std::string constraintNameOf(const std::string& experimentText) {
  const JsonNode root = parseJson(experimentText, "experiment");
  const JsonNode* constraint = root.find("constraint");
  const JsonNode* name = constraint == nullptr ? nullptr : constraint->find("name");
  return name == nullptr ? "" : name->string;
}

/// Whether points differ in the trials that they ask of a subject, as far as the keys tell.
bool variesTrials(const Design& design) {
  const Point first = pointAt(design, 0);
  return design.planText.empty() ? findOwn(first, "trials") != nullptr : !patchesOf(first, "plan.").empty();
}

}  // namespace

std::string unquoted(const std::string& json) { return json.size() > 1 && json.front() == '"' ? json.substr(1, json.size() - 2) : json; }

std::int64_t pointCount(const Design& design) {
  std::int64_t count = design.samples;
  for (const VariedKey& axis : design.axes)
    if (!axis.uniform) count *= static_cast<std::int64_t>(axis.values.size());
  return count;
}

std::int64_t pairCount(const Design& design) { return pointCount(design) * design.subjects; }

Point pointAt(const Design& design, std::int64_t index) {
  Point point;
  point.index = index;
  point.ofAxes.resize(design.axes.size());
  const std::int64_t sample = index % design.samples;
  std::int64_t rest = index / design.samples;
  for (std::size_t k = design.axes.size(); k-- > 0;) {
    const VariedKey& axis = design.axes[k];
    point.ofAxes[k].path = axis.path;
    if (axis.uniform) {
      const auto drawn = philox(
          {static_cast<std::uint32_t>(sample), static_cast<std::uint32_t>(sample >> 32), static_cast<std::uint32_t>(k), kSampleStream},
          keyOf(design));
      point.ofAxes[k].value = fmt::format("{}", axis.uniform->first + (axis.uniform->second - axis.uniform->first) * fractionOf(drawn));
    } else {
      const auto count = static_cast<std::int64_t>(axis.values.size());
      point.ofAxes[k].value = axis.values[static_cast<std::size_t>(rest % count)];
      rest /= count;
    }
  }
  return point;
}

PointTask taskOf(const Design& design, const Point& point) try {
  PointTask task;
  task.device = deviceOf(design, point);
  const std::vector<experiment::Patch> patches = patchesOf(point, "");
  const auto experimentOf = [&](const std::string& name, std::vector<experiment::Patch> changes = {}) {
    changes.insert(changes.end(), patches.begin(), patches.end());
    const std::string& own = design.experimentTexts.at(name);
    PointExperiment made{name, changes.empty() ? own : experiment::patchedText(own, name, changes), {}};
    if (design.definitionTexts.empty()) return made;
    if (const auto found = design.definitionTexts.find(constraintNameOf(made.text)); found != design.definitionTexts.end())
      made.definition = found->second;
    return made;
  };
  if (design.planText.empty()) {
    const experiment::Patch* other = findOwn(point, "experiment");
    task.experiments.push_back(experimentOf(other != nullptr ? unquoted(other->value) : design.experiment));
    session::PlanBlock& block = task.plan.blocks.emplace_back();
    block.experiment = task.experiments.back().name;
    block.trials = trialsOf(design, point);
  } else {
    task.plan = planOf(design, point);
    for (const session::PlanBlock& block : task.plan.blocks) {
      if (!design.experimentTexts.contains(experimentNameOf(block)))
        throw FaultError(Fault{"plan.blocks", "names another experiment", "the plan's own experiments"});
      task.experiments.push_back(experimentOf(experimentNameOf(block), block.changes));
    }
  }
  task.days = daysOf(task.plan);
  return task;
} catch (const FaultError&) {
  rethrowAt(point);
}

void rethrowAt(const Point& point) {
  const std::string what = describe(point), where = fmt::format("point {}{}", point.index, what.empty() ? "" : " (" + what + ")");
  try {
    throw;
  } catch (const FaultError& error) {
    std::vector<Fault> faults = error.faults;
    for (Fault& fault : faults) {
      if (fault.key.starts_with("point ")) continue;
      fault.key = where + (fault.key.empty() ? "" : ": " + fault.key);
      fault.place.reset();
    }
    throw FaultError(std::move(faults));
  } catch (const RefusedError& error) {
    throw RefusedError(where + ": " + error.what());
  }
}

std::string describe(const Point& point) {
  std::string text;
  for (const experiment::Patch& patch : point.ofAxes)
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", patch.path, unquoted(patch.value));
  return text;
}

std::int64_t mostTrialsOfSubject(const Design& design) {
  if (!design.planText.empty()) {
    constexpr std::int64_t kLooked = 1000;
    std::int64_t most = 0;
    for (std::int64_t i = 0; i < (variesTrials(design) ? std::min(kLooked, pointCount(design)) : 1); ++i)
      most = std::max(most, trialsOf(planOf(design, pointAt(design, i))));
    return most;
  }
  std::int64_t most = 0;
  for (const VariedKey& axis : design.axes)
    if (axis.path == "trials")
      for (const std::string& value : axis.values) most = std::max<std::int64_t>(most, std::strtoll(value.c_str(), nullptr, 10));
  return most > 0 ? most : design.trials;
}

std::int64_t trialsOfPairs(const Design& design, std::int64_t most, std::int64_t first, std::int64_t end) {
  if (!variesTrials(design)) return (end - first) * most;
  std::int64_t trials = 0;
  while (first < end) {
    const std::int64_t point = first / design.subjects, next = std::min(end, (point + 1) * design.subjects);
    const Point at = pointAt(design, point);
    trials += (next - first) * (design.planText.empty() ? trialsOf(design, at) : trialsOf(planOf(design, at)));
    first = next;
  }
  return trials;
}

std::uint64_t seedOf(const Design& design, std::int64_t point, std::int64_t subject, int day) {
  const auto words =
      philox({static_cast<std::uint32_t>(point), static_cast<std::uint32_t>(subject), static_cast<std::uint32_t>(day), kSubjectStream},
             keyOf(design));
  return bitsOf(words) >> 11;
}

std::string labelOfSubject(std::int64_t subject) { return fmt::format("{:02}", subject); }

}  // namespace reachlab::study
