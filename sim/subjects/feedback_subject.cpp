#include "sim/subjects/feedback_subject.h"

#include <cmath>

#include "base/fault.h"
#include "base/math/elementary.h"
#include "sim/subjects/feedback_hand.h"
#include "sim/subjects/subject_parameters.h"

namespace reachlab::subjects {
namespace {

constexpr double kPracticeOfLearners = 1.5, kFastOfLearners = 0.03, kSlowOfLearners = 0.008;  // fitted to Table 2 with what follows

/// The five of Table 2: what they take the object for at first, and how noisy and quick to learn they are. Fitted.
struct Person {
  double stiffness, mass, noise, gain;
};
constexpr Person kPeople[] = {
    {-0.51, -0.25, 1.35, 0.8}, {0.47, 0.30, 1.2, 1.0}, {-0.30, 0.25, 1.0, 1.0}, {0.35, -0.20, 0.7, 1.2}, {-0.40, -0.30, 1.0, 0.9}};

/// How people differ where they are drawn: SDs of the five above.
constexpr double kStiffnessSd = 0.45, kMassSd = 0.28, kNoiseSd = 0.24, kGainSd = 0.15;

FeedbackSpec withPerson(FeedbackSpec spec, const Person& person) {
  spec.first = {spec.first.stiffness + person.stiffness, spec.first.mass + person.mass};
  spec.noiseScale = person.noise;
  spec.learning.learnFast *= person.gain;
  spec.learning.learnSlow *= person.gain;
  return spec;
}

/// Once this person is known: its noise is that of command, senses and plan alike.
FeedbackSpec scaled(FeedbackSpec spec) {
  spec.motorNoise *= spec.noiseScale;
  spec.forceNoise *= spec.noiseScale;
  for (double* sd : {&spec.senses.position, &spec.senses.velocity, &spec.senses.force, &spec.senses.seen}) *sd *= spec.noiseScale;
  return spec;
}

Person drawPerson(std::uint64_t seed) {
  constexpr std::uint64_t kPersonStream = 0x706572736f6e;
  SubjectDraws draws(seed ^ kPersonStream, 0);
  return {kStiffnessSd * draws.boundedNormal(), kMassSd * draws.boundedNormal(), elementary::exp(kNoiseSd * draws.boundedNormal()),
          elementary::exp(kGainSd * draws.boundedNormal())};
}

}  // namespace

FeedbackSpec parseFeedbackSubject(const std::string& text) {
  SubjectOptions options(text, feedbackParameters());
  static_cast<void>(options.word("kind", {"ofc"}));
  const auto number = [&](std::string_view key) { return options.number(key); };
  FeedbackSpec spec;
  const std::string subject = options.word("subject", {"practised", "1", "2", "3", "4", "5", "drawn"});
  const bool learner = subject != "practised";
  const auto ofLearners = [&](std::string_view key, double usual) {
    return options.number(key, learner ? std::optional(usual) : std::nullopt);
  };
  const std::string criterion = options.take("criterion").value_or("effort");
  if (criterion != "effort") {
    spec.criterion = predict::criterionFromName(criterion);
    if (!spec.criterion)
      throw FaultError(Fault{"device", "simulated: criterion=" + criterion, "effort, or a name from `reach list criteria`"});
  }
  const std::string sight = options.word("sight", {"ends", "all", "none"});
  spec.senses.sight = sight == "all" ? Sight::All : sight == "none" ? Sight::None : Sight::Ends;
  spec.arm = {number("arm-mass"), number("arm-damping"), number("muscle")};
  spec.senses.position = number("touch-position");
  spec.senses.velocity = number("touch-velocity");
  spec.senses.force = number("touch-force");
  spec.senses.seen = number("sight-position");
  spec.senses.touchDelay = static_cast<int>(std::lround(number("delay-touch") / kControlStep));
  spec.senses.sightDelay = static_cast<int>(std::lround(number("delay-sight") / kControlStep));
  spec.motorNoise = number("motor-noise");
  spec.forceNoise = number("force-noise");
  spec.effort = number("effort");
  spec.criterionEffort = number("criterion-effort");
  spec.criterionWeight = number("criterion-weight");
  spec.timeSd = number("time-sd");
  spec.reaction = number("reaction");
  spec.planSd = {number("plan-sd-stiffness"), number("plan-sd-mass")};
  spec.practice = ofLearners("practice", kPracticeOfLearners);
  spec.practiceTrials = number("practice-trials");
  spec.first = {number("model-stiffness"), number("model-mass")};
  spec.learning = {ofLearners("learn-fast", kFastOfLearners), number("keep-fast"), ofLearners("learn-slow", kSlowOfLearners),
                   number("keep-slow")};
  spec.environment = {number("field-learn-fast"), number("field-keep-fast"), number("field-learn-slow"), number("field-keep-slow")};
  spec.noise = number("noise");
  options.done();
  if (subject == "drawn") spec.drawn = true;
  else if (learner) spec = withPerson(spec, kPeople[subject[0] - '1']);
  return spec;
}

MakeSubject prepareFeedbackSubjects(const experiment::CompiledExperiment& experiment, const FeedbackSpec& spec) {
  const std::shared_ptr<const FeedbackTask> task = makeFeedbackTask(experiment, spec);
  return [task, spec](std::uint64_t seed, int day, std::shared_ptr<void>& learnt) {
    auto state = std::static_pointer_cast<SubjectState>(learnt);
    if (!state) {
      state = std::make_shared<SubjectState>();
      state->person = scaled(spec.drawn ? withPerson(spec, drawPerson(seed)) : spec);
      state->model.first = state->person.first;
      state->model.day = day;
      learnt = state;
    }
    if (state->model.day != day) {  // overnight
      state->model.fast = {};
      state->environment.fast = {};
      state->model.day = day;
    }
    return std::make_unique<FeedbackHand>(task, state, seed);
  };
}

}  // namespace reachlab::subjects
