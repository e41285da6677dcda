// The study's simulation held against another one of the same two people, written from its description.
#include "network/study/two_hands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

using Numbers = std::vector<double>;

double minimumJerkOf(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

// Person h: out together, the second 0.1 s later; back, the first later; then a tug of war from 4 s to 5.6 s.
double meantBy(int h, double t) {
  const double out = minimumJerkOf((t - (h == 1 ? 0.3 : 0.2)) / 1.35), back = minimumJerkOf((t - (h == 0 ? 2.5 : 2.4)) / 1.0);
  const double tug = minimumJerkOf((t - 4) / 0.4) - minimumJerkOf((t - 5.2) / 0.4);
  return 0.2 * (out - back) + (h == 0 ? 0.03 : -0.03) * tug;
}

struct Hand {
  double x = 0, v = 0, x0 = 0, v0 = 0, taken = 0;
  // A millisecond under a force that is held, in a hundred steps.
  void advance(const StudyHand& arm, int h, double t, double force) {
    x0 = x, v0 = v;
    const bool limp = t > 6.4999;
    for (int i = 0; i < 100; ++i) {
      const double now = t + 1e-5 * i;
      const double meant = limp ? 0 : meantBy(h, now), speed = limp ? 0 : (meantBy(h, now + 1e-6) - meantBy(h, now - 1e-6)) / 2e-6;
      const double k = limp ? arm.limpStiffness : arm.stiffness, b = limp ? arm.limpDamping : arm.damping;
      const double a = (k * (meant - x) + b * (speed - v) + force) / arm.mass;
      const double moved = v * 1e-5 + a * 0.5e-10;
      x += moved, v += a * 1e-5;
      taken += force * moved;
    }
  }
};

// Masses on a line, springs between neighbours, and springs of hands to each.
struct Masses {
  Numbers mass, between, damper;            // [kg], [N/m], [N s/m]
  std::vector<Numbers> stiffness, damping;  // of each hand
  Numbers x, v, push;                       // [m], [m/s], [m/s^2]

  Masses(const experiment::Experiment& e, double scale) : mass(e.object.masses) {
    const std::size_t n = mass.size();
    x.assign(n, 0), v.assign(n, 0), push.assign(n, 0);
    between.assign(n, 0), damper.assign(n, 0);
    for (double& m : mass) m *= scale;
    if (e.object.kind == experiment::ObjectKind::Chain)
      for (std::size_t i = 0; i + 1 < n; ++i) between[i] = scale * e.object.stiffness[i], damper[i] = scale * e.object.damping[i];
    for (const experiment::Hand& hand : e.hands) {
      Numbers k(n, 0), b(n, 0);
      if (hand.mass == 0) k = hand.stiffness, b = hand.damping;
      else k[static_cast<std::size_t>(hand.mass - 1)] = hand.stiffness[0], b[static_cast<std::size_t>(hand.mass - 1)] = hand.damping[0];
      stiffness.push_back(k), damping.push_back(b);
    }
  }
  // [N] by hand h at this place and speed.
  double forceOf(std::size_t h, double place, double speed, const Numbers& at, const Numbers& fast) const {
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i) sum += stiffness[h][i] * (place - at[i]) + damping[h][i] * (speed - fast[i]);
    return sum;
  }
  Numbers accelerations(const Numbers& at, const Numbers& fast, const std::vector<Hand>& hands, double s) const {
    Numbers a = push;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      double force = 0;
      if (i + 1 < mass.size()) force += between[i] * (at[i + 1] - at[i]) + damper[i] * (fast[i + 1] - fast[i]);
      if (i > 0) force -= between[i - 1] * (at[i] - at[i - 1]) + damper[i - 1] * (fast[i] - fast[i - 1]);
      for (std::size_t h = 0; h < hands.size(); ++h)
        force += stiffness[h][i] * (hands[h].x0 + s * (hands[h].x - hands[h].x0) - at[i]) +
                 damping[h][i] * (hands[h].v0 + s * (hands[h].v - hands[h].v0) - fast[i]);
      a[i] += force / mass[i];
    }
    return a;
  }
  // A millisecond, in four steps of the classical Runge-Kutta method; the hands go straight.
  void step(const std::vector<Hand>& hands) {
    constexpr double dt = 2.5e-4;
    for (int k = 0; k < 4; ++k) {
      const auto moved = [](const Numbers& a, double c, const Numbers& b) {
        Numbers sum = a;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += c * b[i];
        return sum;
      };
      const double s = 0.25 * k;
      const Numbers a1 = accelerations(x, v, hands, s), v2 = moved(v, dt / 2, a1);
      const Numbers a2 = accelerations(moved(x, dt / 2, v), v2, hands, s + 0.125), v3 = moved(v, dt / 2, a2);
      const Numbers a3 = accelerations(moved(x, dt / 2, v2), v3, hands, s + 0.125), v4 = moved(v, dt, a3);
      const Numbers a4 = accelerations(moved(x, dt, v3), v4, hands, s + 0.25);
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += dt / 6 * (v[i] + 2 * v2[i] + 2 * v3[i] + v4[i]);
        v[i] += dt / 6 * (a1[i] + 2 * a2[i] + 2 * a3[i] + a4[i]);
      }
    }
  }
};

double squaresOf(const Numbers& v) { return std::inner_product(v.begin(), v.end(), v.begin(), 0.0); }

// What the simulation gives, tick by tick.
struct Course {
  std::array<Numbers, 2> force;
  std::vector<std::array<Numbers, 2>> places;  // as each person sees them
  double given = -1e9, growth = 0;
};

// One way of joining the people: advances the objects and says the forces on the hands, and what each sees.
struct Way {
  std::function<std::array<double, 2>(const std::array<Hand, 2>&)> tick;
  std::function<Numbers(int)> seen;
  std::function<double()> speedSquares;
};

Course courseOf(const StudySetup& setup, const Way& way) {
  Course course;
  std::array<Hand, 2> hands;
  std::array<double, 2> force{};
  double early = 0, late = 0;
  int earlyCount = 0, lateCount = 0;
  for (int k = 0; k < 13'000; ++k) {
    for (int h = 0; h < 2; ++h) hands[static_cast<std::size_t>(h)].advance(setup.hand, h, 1e-3 * k, force[static_cast<std::size_t>(h)]);
    force = way.tick(hands);
    for (std::size_t h = 0; h < 2; ++h) course.force[h].push_back(force[h]);
    course.places.push_back({way.seen(0), way.seen(1)});
    course.given = std::max(course.given, hands[0].taken + hands[1].taken);
    const double squares = way.speedSquares() + hands[0].v * hands[0].v + hands[1].v * hands[1].v;
    if (k >= 7000 && k < 7999) early += squares, ++earlyCount;
    if (k >= 12'000) late += squares, ++lateCount;
  }
  course.growth = std::sqrt(late / lateCount / (early / earlyCount));
  return course;
}

// Both hands on one object.
Course together(const StudySetup& setup) {
  Masses object(setup.experiment, 1);
  return courseOf(setup, {[&](const std::array<Hand, 2>& hands) {
                            object.step({hands[0], hands[1]});
                            std::array<double, 2> force{};
                            for (std::size_t h = 0; h < 2; ++h) force[h] = -object.forceOf(h, hands[h].x, hands[h].v, object.x, object.v);
                            return force;
                          },
                          [&](int) { return object.x; }, [&] { return 2 * squaresOf(object.v); }});
}

// The object at the first station; the second hand's place comes there `delay` ticks late, what comes back as late again.
Course overServer(const StudySetup& setup, std::size_t delay, bool sendsForce) {
  Masses object(setup.experiment, 1);
  struct Sent {
    Hand hand;
    Numbers x, v;
    double force = 0;
  };
  std::vector<Sent> sent;
  std::array<double, 2> force{};
  Numbers seen = object.x, fast = object.v;
  Hand before;
  return courseOf(setup,
                  {[&](const std::array<Hand, 2>& hands) {
                     sent.emplace_back().hand = hands[1];
                     Hand there = sent.size() > delay ? sent[sent.size() - 1 - delay].hand : Hand{};
                     there.x0 = before.x, there.v0 = before.v;
                     before = there;
                     object.step({hands[0], there});
                     sent.back().x = object.x, sent.back().v = object.v;
                     sent.back().force = -object.forceOf(1, there.x, there.v, object.x, object.v);
                     force[0] = -object.forceOf(0, hands[0].x, hands[0].v, object.x, object.v);
                     if (sent.size() > delay) {
                       const Sent& back = sent[sent.size() - 1 - delay];
                       seen = back.x, fast = back.v;
                       force[1] = sendsForce ? back.force : -object.forceOf(1, hands[1].x, hands[1].v, seen, fast);
                     }
                     return force;
                   },
                   [&](int station) { return station == 0 ? object.x : seen; }, [&] { return squaresOf(object.v) + squaresOf(fast); }});
}

double rms(const std::function<double(std::size_t)>& difference) {
  double sum = 0;
  for (std::size_t k = 0; k < 6499; ++k) sum += difference(k);
  return std::sqrt(sum / 6499);
}

StudySetup setupOf(StudyObject object) {
  StudySetup setup;
  setup.experiment = makeStudyExperiment(object, 400, 3, 1);
  setup.hand = {.mass = 1.5, .stiffness = 250, .damping = 30, .limpStiffness = 25, .limpDamping = 4};
  setup.jitterShare = 0;
  setup.loss = 0;
  return setup;
}

double forceErrorOf(const Course& course, const Course& reference) {
  return rms([&](std::size_t k) {
    double sum = 0;
    for (std::size_t h = 0; h < 2; ++h) sum += std::pow(course.force[h][k] - reference.force[h][k], 2);
    return sum / 2;
  });
}

double apartOf(const Course& course) {
  return rms([&](std::size_t k) {
    const auto& [one, other] = course.places[k];
    double sum = 0;
    for (std::size_t i = 0; i < one.size(); ++i) sum += std::pow(one[i] - other[i], 2) / static_cast<double>(one.size());
    return sum;
  });
}

TEST(TwoHandsStudy, ItsReferenceIsTheMotionThatItDescribes) {
  for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel}) {
    const StudySetup setup = setupOf(object);
    const Course expected = together(setup);
    const StudyReference reference = makeReference(setup);
    const double size = rms([&](std::size_t k) { return (std::pow(expected.force[0][k], 2) + std::pow(expected.force[1][k], 2)) / 2; });
    ASSERT_GT(size, 1);
    EXPECT_NEAR(reference.rms, size, 2e-3 * size);
    for (std::size_t h = 0; h < 2; ++h) {
      ASSERT_EQ(reference.force[h].size(), 13'000u);
      for (std::size_t k = 0; k < 13'000; ++k) ASSERT_NEAR(reference.force[h][k], expected.force[h][k], 0.02 * size) << h << " " << k;
    }
    EXPECT_NEAR(reference.growth, expected.growth, 0.03 * expected.growth);
  }
}

TEST(TwoHandsStudy, WithoutALineTheServerIsTheReference) {
  const StudySetup setup = setupOf(StudyObject::Chain);
  const StudyReference reference = makeReference(setup);
  for (const Coupling coupling : {Coupling::ServerForce, Coupling::ServerPlace}) {
    const StudyOutcome outcome = runTwoHands(setup, coupling, {}, reference);
    EXPECT_TRUE(outcome.stable);
    EXPECT_EQ(outcome.apart, 0);
    EXPECT_NEAR(outcome.forceError, 0, 1e-9);
    EXPECT_NEAR(outcome.growth, reference.growth, 1e-9);
    EXPECT_EQ(outcome.force, reference.rms);
    EXPECT_EQ(outcome.ledgerWorst, 0) << "there is no ledger";
  }
}

TEST(TwoHandsStudy, OverALineTheServerHearsAndIsHeardLate) {
  for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel})
    for (const bool sendsForce : {true, false}) {
      SCOPED_TRACE(testing::Message() << nameOf(sendsForce ? Coupling::ServerForce : Coupling::ServerPlace));
      StudySetup setup = setupOf(object);
      const Course reference = together(setup), expected = overServer(setup, 2, sendsForce);
      const StudyReference without = makeReference(setup);
      setup.roundTrip = 0.004;
      setup.jitterShare = -0.25;  // takes off what the line adds to every delay: half a millisecond either way
      const StudyOutcome outcome = runTwoHands(setup, sendsForce ? Coupling::ServerForce : Coupling::ServerPlace, {}, without);
      EXPECT_NEAR(outcome.apart, apartOf(expected), 0.02 * apartOf(expected));
      EXPECT_NEAR(outcome.forceError, forceErrorOf(expected, reference), 0.03 * forceErrorOf(expected, reference));
      EXPECT_NEAR(outcome.given, expected.given, 0.02 * std::abs(expected.given) + 1e-3);
      EXPECT_NEAR(outcome.growth, expected.growth, 0.05 * expected.growth);
    }
}

TEST(TwoHandsStudy, AHandThatIsThrownEndsARunThatIsNotStable) {
  StudySetup setup = setupOf(StudyObject::Chain);
  const StudyReference reference = makeReference(setup);
  setup.roundTrip = 0.2;
  setup.experiment = makeStudyExperiment(StudyObject::Chain, 2000, 0, 0);
  const StudyOutcome outcome = runTwoHands(setup, Coupling::ServerForce, {}, reference);
  EXPECT_FALSE(outcome.stable);
  EXPECT_TRUE(std::isinf(outcome.growth));
}

TEST(TwoHandsStudy, EveryWayOfCouplingHasANameAndAPhraseOfItsOwn) {
  std::set<std::string> names, phrases;
  for (const Coupling coupling : kCouplings) {
    names.emplace(nameOf(coupling));
    phrases.emplace(describe(coupling));
  }
  EXPECT_EQ(names, (std::set<std::string>{"server-force", "server-place", "copies-held", "copies-guessed", "design", "half-delayed",
                                          "half-projected", "half-waves"}));
  EXPECT_EQ(phrases.size(), kCouplings.size());
}

TEST(TwoHandsStudy, ItsObjectsAndHandsAreThoseOfTheDesign) {
  const experiment::Experiment chain = makeStudyExperiment(StudyObject::Chain), parallel = makeStudyExperiment(StudyObject::Parallel);
  EXPECT_EQ(chain.object.masses, Numbers(5, 0.6));
  EXPECT_EQ(chain.object.stiffness, Numbers(4, 600));
  EXPECT_EQ(chain.object.damping, Numbers(4, 0));
  EXPECT_EQ(chain.hands[0].mass, 1);
  EXPECT_EQ(chain.hands[1].mass, 5);
  for (const experiment::Hand& hand : chain.hands) EXPECT_EQ(hand.stiffness, Numbers{600});
  EXPECT_EQ(parallel.object.masses, Numbers(2, 3));
  EXPECT_EQ(parallel.hands[0].stiffness, (Numbers{50, 250}));
  EXPECT_EQ(parallel.hands[1].stiffness, (Numbers{250, 50}));
  for (const experiment::Experiment* e : {&chain, &parallel}) EXPECT_NEAR(e->task->target[0] - e->task->start[0], 0.2, 1e-12);
  const StudyHand hand;
  EXPECT_EQ(hand.mass, 1);
  EXPECT_EQ(hand.stiffness, 300);
  EXPECT_EQ(hand.damping, 20);
  EXPECT_EQ(hand.limpStiffness, 20);
  EXPECT_EQ(hand.limpDamping, 5);
  const StudySetup setup;
  EXPECT_EQ(setup.jitterShare, 0.1);
  EXPECT_EQ(setup.loss, 0.05);
  EXPECT_EQ(kMostGiven, 0.3);
  EXPECT_EQ(kLedgerAmount, 0.05);
}

TEST(RandomSetups, ArePeopleFromTheirRangesEachOnItsOwn) {
  const auto spread = [](const std::function<double(const StudySetup&)>& of, StudyObject object) {
    double least = 1e9, most = -1e9;
    for (int i = 0; i < 300; ++i) {
      const double value = of(makeRandomSetup(object, 1, i));
      least = std::min(least, value), most = std::max(most, value);
    }
    return std::pair{least, most};
  };
  struct Range {
    std::function<double(const StudySetup&)> of;
    double least, most;
  };
  for (const Range& r : {Range{[](const StudySetup& s) { return s.hand.stiffness; }, 100, 600},
                         Range{[](const StudySetup& s) { return s.hand.damping; }, 5, 40},
                         Range{[](const StudySetup& s) { return s.hand.limpStiffness; }, 0, 60},
                         Range{[](const StudySetup& s) { return s.hand.limpDamping; }, 3, 10},
                         Range{[](const StudySetup& s) { return s.hand.mass; }, 0.5, 2}})
    for (const StudyObject object : {StudyObject::Chain, StudyObject::Parallel}) {
      const auto [least, most] = spread(r.of, object);
      const double slack = 0.03 * (r.most - r.least);
      EXPECT_GE(least, r.least);
      EXPECT_LE(least, r.least + slack);
      EXPECT_LE(most, r.most);
      EXPECT_GE(most, r.most - slack);
    }
  for (int i = 0; i < 6; ++i) {
    const StudySetup chain = makeRandomSetup(StudyObject::Chain, 1, i);
    EXPECT_EQ(chain.experiment.object.damping, Numbers(4, i % 3 == 0 ? 1 : 0)) << "every third damps its own springs";
    EXPECT_EQ(chain.experiment.coupling->damping > 0, i % 2 == 1);
    EXPECT_EQ(chain.seed, 100u + static_cast<unsigned>(i));
    EXPECT_NE(chain.hand.mass, makeRandomSetup(StudyObject::Parallel, 1, i).hand.mass);
    EXPECT_NE(chain.hand.mass, makeRandomSetup(StudyObject::Chain, 2, i).hand.mass);
    EXPECT_EQ(chain.hand.mass, makeRandomSetup(StudyObject::Chain, 1, i).hand.mass);
  }
}

}  // namespace
}  // namespace reachlab::network
