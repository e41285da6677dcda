#include "sim/session/block_scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/math/vec3.h"
#include "constraints/constraint.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/same_record.h"
#include "sim/experiment/task_plane.h"
#include "sim/trial/task_check.h"

namespace reachlab::session {
namespace {

using experiment::CompiledExperiment;

CompiledExperiment changed(const CompiledExperiment& from, const std::vector<experiment::Patch>& changes) {
  if (changes.empty()) return from;
  const experiment::Experiment& e = from.experiment();
  return {experiment::parseExperiment(experiment::patchedText(e.text, e.name, changes), e.name), from};
}

experiment::Patch placeOf(const char* key, const std::vector<double>& place) { return {key, fmt::format("[{}]", fmt::join(place, ","))}; }

// From the target to the start, through the same places in the other order.
std::vector<experiment::Patch> wayBack(const CompiledExperiment& out, const std::vector<double>& target) {
  const experiment::Task& task = experiment::requiredTask(out.experiment());
  std::vector<experiment::Patch> changes{placeOf("task.start", target), placeOf("task.target", task.start)};
  std::vector<std::string> places;
  for (auto place = task.via.rbegin(); place != task.via.rend(); ++place)
    places.push_back(fmt::format("[{},{},{}]", place->x, place->y, place->z));
  if (places.size() > 1) changes.push_back({"task.via_m", fmt::format("[{}]", fmt::join(places, ","))});
  return changes;
}

std::vector<std::vector<double>> targetsOf(const TrialMix& mix, const CompiledExperiment& experiment) {
  const experiment::Task& task = experiment::requiredTask(experiment.experiment());
  if (!mix.ring) return mix.targets.empty() ? std::vector<std::vector<double>>{task.target} : mix.targets;
  if (experiment.constraint().kind != constraints::ConstraintKind::Free)
    throw FaultError(Fault{"targets.ring",
                           fmt::format("lies in free space, and the constraint is {}", experiment.experiment().constraint.name),
                           "a list of places on the constraint, or the constraint free"});
  std::vector<std::vector<double>> targets;
  for (int i = 0; i < mix.ring->count; ++i) {
    const double degrees = mix.ring->firstDegrees + 360.0 * i / mix.ring->count;
    const Vec3 way = experiment::rotated({mix.ring->radius, 0, 0}, experiment::normalOf(task.plane), experiment::rotationInPlane(degrees));
    const auto rounded = [](double metres) { return std::round(metres * 1e12) / 1e12 + 0.0; };  // a target straight ahead has the start's x
    targets.push_back({rounded(task.start.at(0) + way.x), rounded(task.start.at(1) + way.y), rounded(task.start.at(2) + way.z)});
  }
  return targets;
}

void checkDomain(const std::vector<double>& target, const constraints::Constraint& constraint) {
  for (std::size_t i = 0; i < target.size() && constraint.kind != constraints::ConstraintKind::Free && i < constraint.domain.size(); ++i) {
    const constraints::Domain& domain = constraint.domain[i];
    if (!domain.has(target[i]))
      throw FaultError(Fault{"", fmt::format("has {}, which is outside the constraint's domain", target[i]),
                             fmt::format("{} to {}", domain.lo, domain.hi)});
  }
}

void checkKind(const TrialMix& mix, const CompiledExperiment& experiment, const CompiledExperiment& of) {
  if (const auto fault = experiment::differenceInRecord(experiment.experiment(), of.experiment())) throw FaultError(*fault);
  const auto& task = experiment.experiment().task;
  const auto& ofKind = of.experiment().task;
  if ((mix.ring || !mix.targets.empty()) && task && ofKind && task->target != ofKind->target)
    throw FaultError(Fault{"task.target", "is changed by a kind of a block that has targets", "the key targets alone"});
}

}  // namespace

std::vector<SceneName> sceneNames(const PlanBlock& block) {
  const TrialMix& mix = block.mix;
  if (mix.isPlain()) return {{"", "", conditionOf(block)}};
  std::vector<SceneName> names;
  const bool ways = mix.targetCount() > 1 || mix.wayBack;  // a trial's target sets it apart
  const auto add = [&](const std::string& kind, const std::string& target) {
    std::string condition = block.condition.empty() && kind.empty() ? conditionOf(block) : block.condition;
    for (const std::string& part : {kind, ways ? target : std::string()})
      if (!part.empty()) condition += (condition.empty() ? "" : " ") + part;
    names.push_back({kind, target, condition});
  };
  for (const std::string& kind : kindsInUse(mix))
    for (int t = 1; t <= mix.targetCount(); ++t) {
      add(kind, fmt::format("{}", t));
      if (mix.wayBack) add(kind, fmt::format("{}-back", t));
    }
  return names;
}

std::vector<BlockScene> scenesOf(const PlanBlock& block, const CompiledExperiment& experiment) {
  const TrialMix& mix = block.mix;
  const std::vector<SceneName> names = sceneNames(block);
  if (mix.isPlain()) return {{names.front(), experiment}};
  std::vector<BlockScene> scenes;
  std::vector<Fault> faults;
  const auto add = [&](const CompiledExperiment& of) { scenes.push_back({names.at(scenes.size()), of}); };
  const auto collect = [&](const auto& work) {
    try {
      work();
    } catch (const FaultError& error) {
      for (const Fault& fault : error.faults)
        if (std::find(faults.begin(), faults.end(), fault) == faults.end()) faults.push_back(fault);
    }
  };
  const auto addTargets = [&](const std::string& kind, const CompiledExperiment& ofKind) {
    const std::vector<std::vector<double>> targets = targetsOf(mix, ofKind);
    for (std::size_t t = 0; t < targets.size(); ++t) {
      const std::string key = mix.ring ? "targets.ring" : mix.targets.empty() ? "kinds." + kind : fmt::format("targets[{}]", t);
      collect([&] {
        underKey(key, [&] {
          if (!mix.targets.empty()) checkDomain(targets[t], ofKind.constraint());
          const CompiledExperiment out = changed(ofKind, {placeOf("task.target", targets[t])});
          if (const std::vector<Fault> wrong = trial::taskProblems(out); !wrong.empty()) throw FaultError(wrong);
          add(out);
          if (mix.wayBack) add(changed(ofKind, wayBack(ofKind, targets[t])));
        });
      });
    }
  };
  for (const std::string& name : kindsInUse(mix))
    collect([&] {
      CompiledExperiment ofKind = experiment;
      for (const TrialKind& kind : mix.kinds)
        if (kind.name == name)
          underKey("kinds." + name, [&] {
            ofKind = changed(experiment, kind.changes);
            checkKind(mix, experiment, ofKind);
          });
      addTargets(name, ofKind);
    });
  if (!faults.empty()) throw FaultError(std::move(faults));
  return scenes;
}

}  // namespace reachlab::session
