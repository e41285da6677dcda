#include "sim/subjects/plans/simulated_hand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/fault.h"
#include "base/math/elementary.h"
#include "base/math/lanes.h"
#include "base/ticks.h"
#include "sim/subjects/plans/played_hand.h"
#include "sim/subjects/plans/sampled_plan.h"
#include "sim/subjects/plans/subject_draws.h"

namespace reachlab::subjects {
namespace {

/// A smooth random function of time with unit variance: a few sinusoids of voluntary movement's frequencies, turned on from tick to tick.
class SmoothNoise {
 public:
  explicit SmoothNoise(SubjectDraws& random) {
    for (int i = 0; i < kWaves; ++i) {
      const double omega = 2 * std::numbers::pi * (kLowest + (kHighest - kLowest) * random.uniform());
      const double phase = 2 * std::numbers::pi * random.uniform();
      sine_[i] = elementary::sin(phase);
      cosine_[i] = elementary::cos(phase);
      turnSine_[i] = elementary::sin(omega * kTickSeconds);
      turnCosine_[i] = elementary::cos(omega * kTickSeconds);
    }
  }
  /// At the next tick; the first is one tick after time 0.
  double next() {
    const Waves sine = mulAdd(sine_, turnCosine_, cosine_ * turnSine_);
    cosine_ = mulAdd(cosine_, turnCosine_, -(sine_ * turnSine_));
    sine_ = sine;
    return (sine[0] + sine[1] + sine[2] + sine[3]) * kScale;
  }

 private:
  static constexpr double kLowest = 0.5, kHighest = 4;  // [Hz]
  static constexpr int kWaves = 4;
  static constexpr double kScale = std::numbers::sqrt2 / 2;  // of four waves
  using Waves = Lanes<kWaves>;
  Waves sine_{}, cosine_{}, turnSine_{}, turnCosine_{};
};

struct Frame {
  Vec3 along, across, up;
};
// `e` is of unit length.
Frame frameOf(const Vec3& e) {
  const Vec3 helper = std::abs(e.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
  const Vec3 beside = cross(e, helper), across = beside / norm(beside);
  return {e, across, cross(across, e)};
}

PlayedReach carryOut(const SampledPlan& plan, const SubjectSpec& subject, std::uint64_t seed, int trial) {
  SubjectDraws random(seed, static_cast<std::uint64_t>(trial));
  const double stretch = 1 + subject.noise * subject.timeSd * random.boundedNormal();
  const double reaction = random.reaction(subject.reaction, subject.noise);
  SmoothNoise along(random), across(random), up(random);
  const double sd = subject.noise * subject.speedSd;

  const double duration = plan.duration() * stretch;
  const auto still = static_cast<std::size_t>(std::max(1.0, reaction / kTickSeconds));
  const auto steps = static_cast<std::size_t>(std::ceil(duration / kTickSeconds));
  PlayedReach reach;
  reach.position.reserve(still + steps + 2);
  Vec3 planned = plan.at(0), hand = planned;
  Frame frame;  // of the way here; mostly a straight one
  reach.position.assign(still, planned);
  for (std::size_t i = 1; i <= steps; ++i) {
    const double t = std::min(static_cast<double>(i) * kTickSeconds, duration);
    const Vec3 next = plan.at(std::min(t / stretch, plan.duration())), by = next - planned;
    planned = next;
    hand += by;
    if (sd > 0) {
      const double a = along.next(), b = across.next(), c = up.next();
      if (const double distance = norm(by); distance > 0) {
        if (const Vec3 e = by / distance; !(e == frame.along)) frame = frameOf(e);
        hand += sd * distance * (a * frame.along + b * frame.across + c * frame.up);
      }
    }
    reach.position.push_back(hand);
  }
  reach.position.push_back(hand);
  const std::size_t count = reach.position.size();
  reach.velocity.resize(count);
  for (std::size_t i = 1; i + 1 < count; ++i) reach.velocity[i] = (reach.position[i + 1] - reach.position[i - 1]) / (2 * kTickSeconds);
  return reach;
}

}  // namespace

SubjectSpec takeSubject(DeviceOptions& options) {
  SubjectSpec subject;
  subject.noise = options.number("noise", subject.noise, 0, 10);
  if (const auto name = options.take("criterion")) {
    subject.criterion = predict::criterionFromName(*name);
    if (!subject.criterion) throw FaultError(Fault{"device", "criterion=" + *name, "a name from `reach list criteria`"});
  }
  constexpr double kNotGiven = -1;
  if (const double mass = options.number("hand-mass", kNotGiven, 0, 1000); mass != kNotGiven) subject.handMass = mass;
  subject.timeSd = options.number("time-sd", subject.timeSd, 0, 0.3);
  subject.speedSd = options.number("speed-sd", subject.speedSd, 0, 1);
  subject.reaction = options.number("reaction", subject.reaction, 0, 5);
  return subject;
}

MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject) {
  const auto plan = std::make_shared<const SampledPlan>(makeReachPlan(experiment, subject.criterion, subject.handMass));
  return [=](std::uint64_t seed, int, std::shared_ptr<void>&) {
    return std::make_unique<PlayedHand>(haptics::DeviceInfo{.name = "simulated", .version = "1"},
                                        [=](int trial) { return carryOut(*plan, subject, seed, trial); });
  };
}

std::unique_ptr<haptics::HapticDevice> makeSimulatedHand(const experiment::CompiledExperiment& experiment, const SubjectSpec& subject,
                                                         std::uint64_t seed) {
  std::shared_ptr<void> learnt;
  return prepareSubjects(experiment, subject)(seed, 0, learnt);
}

}  // namespace reachlab::subjects
