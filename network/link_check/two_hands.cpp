#include "network/link_check/two_hands.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "network/link_check/copies_over_links.h"
#include "network/link_check/growth.h"

namespace reachlab::network {
namespace {

constexpr double kRelaxAt = 6.5, kEnd = 13;  // [s]
constexpr int kTicks = static_cast<int>(kEnd / kTickSeconds + 0.5);
constexpr double kStep = kTickSeconds / kSubsteps;
// On this line a metre is a unit of phi.
constexpr double kStart = 0;

// Where person h means to be [m]: out together (the second 0.1 s later), back (the first later), a tug of war.
double intended(int h, double t) {
  constexpr double kReach = 0.2, kTug = 0.03, kLate = 0.1;
  const auto reach = [](double since, double duration) {
    return since <= 0 ? 0.0 : since >= duration ? 1.0 : minimumJerk(since / duration);
  };
  double place = kReach * (reach(t - 0.2 - (h == 1 ? kLate : 0), 1.35) - reach(t - 2.4 - (h == 0 ? kLate : 0), 1.0));
  if (t > 4) place += (h == 1 ? -kTug : kTug) * (reach(t - 4, 0.4) - reach(t - 5.2, 0.4));
  return place;
}
double intendedSpeed(int h, double t) {
  constexpr double kNear = 1e-5;
  return (intended(h, t + kNear) - intended(h, t - kNear)) / (2 * kNear);
}

/// A person's hand.
struct Body {
  double x = 0, v = 0;              // [m], [m/s] now
  double beforeX = 0, beforeV = 0;  // at the tick before
  double taken = 0;                 // [J] by the force on it

  // One tick under a held force.
  void advance(const SimulatedArm& arm, int h, double t, double force) {
    beforeX = x, beforeV = v;
    const bool limp = t >= kRelaxAt;
    const double k = limp ? arm.limpStiffness : arm.stiffness, b = limp ? arm.limpDamping : arm.damping;
    for (int i = 0; i < kSubsteps; ++i) {
      const double now = t + i * kStep, was = v;
      const double meant = limp ? 0 : intended(h, now), speed = limp ? 0 : intendedSpeed(h, now);
      v += (k * (meant - x) + b * (speed - v) + force) / arm.mass * kStep;
      const double moved = kStep * 0.5 * (was + v);
      x += moved;
      taken += force * moved;
    }
  }
  dynamics::HandSegment segment() const { return dynamics::straightSegment({{beforeX, 0, 0}, {beforeV, 0, 0}}, sample()); }
  dynamics::HandSample sample() const { return {{x, 0, 0}, {v, 0, 0}, true}; }
};
using Bodies = std::array<Body, 2>;

/// [N] on each hand, from this tick to the next.
using Forces = std::array<double, 2>;

LinkConditions conditionsOf(const TwoHandsSetup& setup) {
  constexpr double kLeastJitter = 0.0005;  // [s]
  const double delay = setup.roundTrip / 2;
  return {delay, setup.jitterShare * delay + (setup.roundTrip > 0 ? kLeastJitter : 0), setup.loss};
}

// Runs to the end, or until `look` says that it has gone far enough. `tick`: one that ends at t, with the bodies where they are then; it
// answers the speed squares of both objects [m^2/s^2]. Returns the growth.
template <class Tick, class Look>
double conduct(const TwoHandsSetup& setup, Forces& force, Tick&& tick, Look&& look) {
  Bodies bodies;
  Growth growth(kRelaxAt, kEnd);
  for (int k = 0; k < kTicks; ++k) {
    for (std::size_t h = 0; h < 2; ++h) bodies[h].advance(setup.arm, static_cast<int>(h), secondsOf(k), force[h]);
    const double t = secondsOf(k + 1);
    const double squares = tick(bodies, t);
    growth.add(t, squares + bodies[0].v * bodies[0].v + bodies[1].v * bodies[1].v);
    if (!look(k, t, bodies)) return std::numeric_limits<double>::infinity();
  }
  return growth.ratio();
}

bool isThrown(const Bodies& bodies) { return !(std::max(std::abs(bodies[0].x), std::abs(bodies[1].x)) < kFarAway); }

}  // namespace

TwoHandsReference makeReference(const TwoHandsSetup& setup) {
  const auto plant = dynamics::makeSharedPlant(setup.experiment, constraints::makeConstraint(setup.experiment.constraint));
  plant->placeAtRest(std::array{kStart});
  TwoHandsReference reference;
  Forces force{};
  double squares = 0;
  int count = 0;
  for (auto& course : reference.force) course.reserve(kTicks);
  reference.growth = conduct(
      setup, force,
      [&](const Bodies& bodies, double) {
        plant->setHand(1, bodies[1].segment(), bodies[1].sample());
        (void)plant->step(bodies[0].segment(), kTickSeconds);
        for (std::size_t h = 0; h < 2; ++h) force[h] = -plant->couplingForceOf(static_cast<int>(h)).x;
        double sum = 0;
        for (const double rate : plant->rates()) sum += rate * rate;
        return 2 * sum;  // as of two copies
      },
      [&](int, double t, const Bodies&) {
        for (std::size_t h = 0; h < 2; ++h) {
          reference.force[h].push_back(force[h]);
          if (t < kRelaxAt) squares += force[h] * force[h], ++count;
        }
        return true;
      });
  reference.rms = std::sqrt(squares / count);
  return reference;
}

TwoHandsOutcome runTwoHands(const TwoHandsSetup& setup, const CopySettings& settings, const TwoHandsReference& reference) {
  CopiesOverLinks copies(setup.experiment, constraints::makeConstraint(setup.experiment.constraint), std::array{kStart}, settings,
                         conditionsOf(setup), setup.roundTrip, setup.seed);
  TwoHandsOutcome outcome;
  outcome.force = reference.rms;
  Forces force{};
  double apart = 0, error = 0, above = 0;
  int apartCount = 0, errorCount = 0;
  outcome.given = -std::numeric_limits<double>::infinity();
  outcome.growth = conduct(
      setup, force,
      [&](const Bodies& bodies, double t) {
        const std::array segments{bodies[0].segment(), bodies[1].segment()};
        const std::array ends{bodies[0].sample(), bodies[1].sample()};
        copies.tick(segments, ends, t);
        for (std::size_t h = 0; h < 2; ++h) force[h] = -copies.copy(static_cast<int>(h)).couplingForce(ends[h]).x;
        return copies.speedSquares();
      },
      [&](int k, double t, const Bodies& bodies) {
        outcome.given = std::max(outcome.given, bodies[0].taken + bodies[1].taken);
        const double held = copies.aboveLedger();
        outcome.ledgerWorst = std::max(outcome.ledgerWorst, held);
        above = held > kLedgerAmount ? above + kTickSeconds : 0;
        outcome.ledgerDuration = std::max(outcome.ledgerDuration, above);
        if (t < kRelaxAt) {
          const CopySample &one = copies.sample(0), &other = copies.sample(1);
          for (std::size_t i = 0; i < static_cast<std::size_t>(copies.copy(0).massCount()); ++i)
            apart += (one.places[i] - other.places[i]) * (one.places[i] - other.places[i]), ++apartCount;
          for (std::size_t h = 0; h < 2; ++h) {
            const double by = force[h] - reference.force[h][static_cast<std::size_t>(k)];
            error += by * by, ++errorCount;
          }
        }
        return !isThrown(bodies);
      });
  outcome.apart = std::sqrt(apart / std::max(1, apartCount));
  outcome.forceError = std::sqrt(error / std::max(1, errorCount));
  outcome.stable = outcome.given < kMostGiven && Growth::isStable(outcome.growth, reference.growth) && std::isfinite(outcome.forceError);
  return outcome;
}

std::string_view nameOf(SharedObject object) { return object == SharedObject::Chain ? "chain" : "parallel"; }

experiment::Experiment makeSharedExperiment(SharedObject object, double handStiffness, double handDamping, double chainDamping) {
  experiment::Experiment e;
  e.name = object == SharedObject::Chain ? "chain" : "parallel";
  e.constraint.name.clear();
  e.constraint.curve = {"phi", "0", "0"};
  e.task = experiment::Task{};
  e.task->start = {kStart};
  e.task->target = {kStart + 0.2};
  if (object == SharedObject::Chain) {
    e.object.kind = experiment::ObjectKind::Chain;
    e.object.masses.assign(5, 0.6);
    e.object.stiffness.assign(4, 600);
    e.object.damping.assign(4, chainDamping);
    e.coupling = experiment::Coupling{handStiffness, handDamping};
    e.hands = {{1, {handStiffness}, {handDamping}, {}}, {5, {handStiffness}, {handDamping}, {}}};
  } else {
    e.object.kind = experiment::ObjectKind::Parallel;
    e.object.masses.assign(2, 3);
    e.object.stiffness = {50, 250};
    e.object.damping.assign(2, handDamping);
    e.hands = {{0, {50, 250}, {handDamping, handDamping}, {}}, {0, {250, 50}, {handDamping, handDamping}, {}}};
  }
  return e;
}

TwoHandsSetup makeRandomSetup(SharedObject object, std::uint64_t seed, int index) {
  const std::uint64_t own = seededBits(seed, static_cast<std::uint64_t>(2 * index + (object == SharedObject::Chain ? 0 : 1)));
  std::uint64_t drawn = 0;
  const auto uniform = [&](double least, double most) { return least + (most - least) * seededFraction(own, drawn++); };
  TwoHandsSetup setup;
  const double stiffness = uniform(200, 600), someDamping = uniform(0, 5);
  const double damping = index % 2 == 1 ? someDamping : 0, chainDamping = index % 3 == 0 ? 1 : 0;
  setup.arm.stiffness = uniform(100, 600);
  setup.arm.damping = uniform(5, 40);
  setup.arm.limpStiffness = uniform(0, 60);
  setup.arm.limpDamping = uniform(3, 10);
  setup.arm.mass = uniform(0.5, 2);
  setup.experiment = object == SharedObject::Chain ? makeSharedExperiment(object, stiffness, damping, chainDamping)
                                                   : makeSharedExperiment(object, 0, 0.5 * damping);
  setup.seed = 100 + static_cast<std::uint64_t>(index);
  return setup;
}

}  // namespace reachlab::network
