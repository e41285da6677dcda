#include "sim/subjects/plans/simulated_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/math/elementary.h"
#include "base/math/fused.h"
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
    for (Wave& w : waves_) {
      const double omega = 2 * std::numbers::pi * (kLowest + (kHighest - kLowest) * random.uniform());
      const double phase = 2 * std::numbers::pi * random.uniform();
      w = {elementary::sin(phase), elementary::cos(phase), elementary::sin(omega * kTickSeconds), elementary::cos(omega * kTickSeconds)};
    }
  }
  /// At the next tick; the first is one tick after time 0.
  double next() {
    double sum = 0;
    for (Wave& w : waves_) {
      const double sine = mulAdd(w.sine, w.turnCosine, w.cosine * w.turnSine);
      w.cosine = mulAdd(w.cosine, w.turnCosine, -(w.sine * w.turnSine));
      w.sine = sine;
      sum += sine;
    }
    return sum * kScale;
  }

 private:
  static constexpr double kLowest = 0.5, kHighest = 4;       // [Hz]
  static constexpr double kScale = std::numbers::sqrt2 / 2;  // of four waves
  struct Wave {
    double sine = 0, cosine = 0, turnSine = 0, turnCosine = 0;
  };
  std::array<Wave, 4> waves_{};
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

double readNumber(const std::string& key, const std::string& text, double most) {
  const auto value = asNumber<double>(text);
  if (!value || !(*value >= 0) || !(*value <= most))
    throw FaultError(Fault{"device", fmt::format("simulated: {}={}", key, text), fmt::format("a number from 0 to {}", most)});
  return *value;
}

predict::Criterion readCriterion(const std::string& text) {
  if (const auto criterion = predict::criterionFromName(text)) return *criterion;
  throw FaultError(Fault{"device", "simulated: criterion=" + text, "the name of a criterion"});
}

}  // namespace

SubjectSpec parseSubject(const std::string& text) {
  SubjectSpec subject;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string item = text.substr(at, end - at);
    at = end + 1;
    const std::size_t equals = item.find('=');
    const std::string key = item.substr(0, equals), value = equals == std::string::npos ? "" : item.substr(equals + 1);
    if (key == "kind" && value == "plan") continue;
    if (key == "noise") subject.noise = readNumber(key, value, 10);
    else if (key == "time-sd") subject.timeSd = readNumber(key, value, 0.3);
    else if (key == "speed-sd") subject.speedSd = readNumber(key, value, 1);
    else if (key == "reaction") subject.reaction = readNumber(key, value, 5);
    else if (key == "hand-mass") subject.handMass = readNumber(key, value, 1000);
    else if (key == "criterion") subject.criterion = readCriterion(value);
    else
      throw FaultError(
          Fault{"device", fmt::format("simulated: {} is not known", key), "noise, criterion, hand-mass, time-sd, speed-sd, reaction"});
  }
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
