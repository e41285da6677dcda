#include "sim/subjects/subject_kinds.h"

#include <fmt/format.h>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "sim/subjects/feedback_subject.h"
#include "sim/subjects/hands_in_scenes.h"
#include "sim/subjects/impedance_subject.h"
#include "sim/subjects/subject_parameters.h"

namespace reachlab::subjects {

namespace {

/// A hand that plays its plan cannot be pushed aside. In a channel it need not be.
void requireNothingPushes(const experiment::Experiment& experiment) {
  for (std::size_t i = 0; i < experiment.environment.size(); ++i)
    if (!std::holds_alternative<experiment::ChannelForce>(experiment.environment[i].law))
      throw FaultError(Fault{"device", fmt::format("simulated: kind=plan plays its plan, and environment[{}] cannot push it aside", i),
                             "kind=impedance or kind=ofc, which feel forces on the hand"});
}

void requireStraightWay(const experiment::Experiment& experiment) {
  if (experiment.task && !experiment.task->via.empty())
    throw FaultError(Fault{"device", "simulated: its subjects go straight to the target, and task.via_m has via points",
                           "a force device, mouse, or a replayed hand"});
}

}  // namespace

MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const std::string& device) {
  const std::string name = device.substr(0, device.find(':'));
  if (name != "simulated") throw FaultError(Fault{"subject", "is " + device, "a simulated subject"});
  requireStraightWay(experiment.experiment());
  const std::string options = name == device ? "" : device.substr(name.size() + 1);
  SubjectOptions given(options, {});
  const std::string kind = given.word("kind", {"plan", "impedance", "ofc"});
  if (kind == "ofc") return prepareFeedbackSubjects(experiment, parseFeedbackSubject(options));
  if (kind == "impedance") return prepareImpedanceSubjects(experiment, parseImpedanceSubject(options));
  requireNothingPushes(experiment.experiment());
  const SubjectSpec subject = takeSubject(given);
  given.done();
  return prepareSubjects(experiment, subject);
}

MakeSubject prepareSubjects(std::span<const experiment::CompiledExperiment> scenes, const std::string& device) {
  if (scenes.size() == 1) return prepareSubjects(scenes.front(), device);
  std::vector<MakeSubject> ofScenes;
  for (const experiment::CompiledExperiment& scene : scenes) ofScenes.push_back(prepareSubjects(scene, device));
  return [ofScenes](std::uint64_t seed, int day, std::shared_ptr<void>& learnt) {
    std::vector<std::unique_ptr<haptics::HapticDevice>> hands;
    for (const MakeSubject& make : ofScenes) hands.push_back(make(seed, day, learnt));
    return joinScenes(std::move(hands));
  };
}

}  // namespace reachlab::subjects
