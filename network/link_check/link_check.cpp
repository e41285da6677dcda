#include "network/link_check/link_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/ticks.h"
#include "constraints/constraint.h"
#include "network/link_check/copies_over_links.h"
#include "network/link_check/growth.h"
#include "network/link_check/two_hands.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

constexpr double kLimpEnd = 6.5;            // [s] as long as the study's hands are limp
constexpr double kPush = 0.1;               // [m/s] of the first hand
constexpr double kFrequencyStep = 0.5;      // [rad/s]
constexpr double kMostFrequency = 10;       // [rad/s]: stronger synchronisation is felt as drag
constexpr std::uint64_t kSeeds[] = {1, 2};  // of losses and jitter

/// A hand that lets itself be moved, about where it held the object at first.
struct LimpHand {
  Vec3 home, x, v, beforeX, beforeV;

  void advance(const Vec3& force) {
    constexpr SimulatedArm kArm;
    constexpr double kStep = kTickSeconds / kSubsteps;
    beforeX = x, beforeV = v;
    for (int i = 0; i < kSubsteps; ++i) {
      const Vec3 was = v;
      v += kStep / kArm.mass * (kArm.limpStiffness * (home - x) - kArm.limpDamping * v + force);
      x += 0.5 * kStep * (was + v);
    }
  }
  dynamics::HandSegment segment() const { return dynamics::straightSegment({beforeX, beforeV}, sample()); }
  dynamics::HandSample sample() const { return {x, v, true}; }
};

// Along the way to the target, the others half as fast against the first: both the whole and its inside move.
std::vector<LimpHand> pushedHands(const experiment::Experiment& experiment, const constraints::Constraint& constraint) {
  const auto plant = dynamics::makeSharedPlant(experiment, constraint);
  std::vector<LimpHand> hands(experiment.hands.size());
  plant->placeAtRest(experiment.task->target);
  const Vec3 target = plant->fixedPoint(0);
  plant->placeAtRest(experiment.task->start);
  const Vec3 way = target - plant->fixedPoint(0);
  const Vec3 along = norm(way) > 0 ? way / norm(way) : Vec3{1, 0, 0};
  for (std::size_t i = 0; i < hands.size(); ++i) {
    hands[i].home = hands[i].x = plant->fixedPoint(static_cast<int>(i));
    hands[i].v = (i % 2 == 0 ? kPush : -0.5 * kPush) * along;
  }
  return hands;
}

// `step` takes the object a tick on and answers the speed squares of all of it; `force` on a hand. Infinite: a hand was thrown, or
// nobody waits for the answer any more.
template <class Step, class Force>
double letBe(std::vector<LimpHand> hands, const std::stop_token& stop, Step&& step, Force&& force) {
  Growth growth(0, kLimpEnd);
  std::vector<dynamics::HandSegment> segments(hands.size());
  std::vector<dynamics::HandSample> samples(hands.size());
  std::vector<Vec3> forces(hands.size());
  const int ticks = static_cast<int>(kLimpEnd / kTickSeconds + 0.5);
  for (int k = 1; k <= ticks; ++k) {
    if (stop.stop_requested()) return std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hands.size(); ++i) {
      hands[i].advance(forces[i]);
      segments[i] = hands[i].segment(), samples[i] = hands[i].sample();
    }
    const double t = secondsOf(k);
    double squares = step(segments, samples, t);
    for (std::size_t i = 0; i < hands.size(); ++i) {
      forces[i] = force(static_cast<int>(i), samples[i]);
      squares += dot(hands[i].v, hands[i].v);
      if (!(norm(hands[i].x - hands[i].home) < kFarAway)) return std::numeric_limits<double>::infinity();
    }
    growth.add(t, squares);
  }
  return growth.ratio();
}

double growthAlone(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const std::vector<LimpHand>& hands,
                   const std::stop_token& stop) {
  const auto plant = dynamics::makeSharedPlant(experiment, constraint);
  plant->placeAtRest(experiment.task->start);
  return letBe(
      hands, stop,
      [&](const auto& segments, const auto& samples, double) {
        for (std::size_t i = 1; i < segments.size(); ++i) plant->setHand(static_cast<int>(i), segments[i], samples[i]);
        (void)plant->step(segments[0], kTickSeconds);
        double squares = 0;  // once for each station, as of as many copies
        for (const double rate : plant->rates()) squares += static_cast<double>(segments.size()) * rate * rate;
        return squares;
      },
      [&](int hand, const dynamics::HandSample&) { return -plant->couplingForceOf(hand); });
}

double growthOver(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const std::vector<LimpHand>& hands,
                  const MeasuredLink& link, const CopySettings& settings, const std::stop_token& stop) {
  // Uniform jitter either way makes this standard deviation of the round trip.
  const LinkConditions conditions{link.roundTrip / 2, std::sqrt(1.5) * link.jitter, link.loss};
  double worst = 0;
  for (const std::uint64_t seed : kSeeds) {
    CopiesOverLinks copies(experiment, constraint, experiment.task->start, settings, conditions, link.roundTrip, seed);
    worst = std::max(worst, letBe(
                                hands, stop,
                                [&](const auto& segments, const auto& samples, double t) {
                                  copies.tick(segments, samples, t);
                                  return copies.speedSquares();
                                },
                                [&](int hand, const dynamics::HandSample& sample) { return -copies.copy(hand).couplingForce(sample); }));
  }
  return worst;
}

}  // namespace

MeasuredLink MeasuredLink::worse(const MeasuredLink& a, const MeasuredLink& b) {
  return {std::max(a.roundTrip, b.roundTrip), std::max(a.jitter, b.jitter), std::max(a.loss, b.loss)};
}

LinkCheck checkLink(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const MeasuredLink& link,
                    const CopySettings& settings, const std::stop_token& stop) {
  const std::vector<LimpHand> hands = pushedHands(experiment, constraint);
  const double alone = growthAlone(experiment, constraint, hands, stop);
  const double most = std::min(kMostFrequency, synchronisationLimit(settings, link.roundTrip));
  LinkCheck check;
  CopySettings tried = settings;
  while (true) {
    check.frequency = tried.frequency;
    check.growth = growthOver(experiment, constraint, hands, link, tried, stop);
    check.stable = Growth::isStable(check.growth, alone);
    if (check.stable || tried.frequency >= most || stop.stop_requested()) break;
    tried.frequency = std::min(most, tried.frequency + kFrequencyStep);
  }
  const std::string over =
      fmt::format("round trip {:.1f} ms, jitter {:.1f} ms, loss {:.0f} %", 1e3 * link.roundTrip, 1e3 * link.jitter, 100 * link.loss);
  const bool ended = !check.stable && stop.stop_requested();
  const std::string how = ended ? "ended before it was known"
                          : std::isfinite(check.growth)
                              ? fmt::format("after {:.1f} s {:.2g} times as fast as at first", kLimpEnd, check.growth)
                              : "thrown out of the hands";
  check.sentence = fmt::format("simulated with limp hands over this link ({}) the object {}: {}, synchronised by up to {:.1f} rad/s", over,
                               check.stable ? "comes to rest"
                               : ended      ? "may come to rest or not"
                                            : "does not come to rest",
                               how, check.frequency);
  return check;
}

LinkCheck checkLink(const experiment::Experiment& experiment, const MeasuredLink& link, const std::stop_token& stop) {
  return checkLink(experiment, constraints::makeConstraint(experiment.constraint), link, copySettingsFor(experiment), stop);
}

}  // namespace reachlab::network
