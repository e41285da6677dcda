// The simulation of two people held against another one of the same two people, written from its description.
#include "network/link_check/two_hands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
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
  void advance(const SimulatedArm& arm, int h, double t, double force) {
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

Course courseOf(const TwoHandsSetup& setup, const Way& way) {
  Course course;
  std::array<Hand, 2> hands;
  std::array<double, 2> force{};
  double early = 0, late = 0;
  int earlyCount = 0, lateCount = 0;
  for (int k = 0; k < 13'000; ++k) {
    for (int h = 0; h < 2; ++h) hands[static_cast<std::size_t>(h)].advance(setup.arm, h, 1e-3 * k, force[static_cast<std::size_t>(h)]);
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
Course together(const TwoHandsSetup& setup) {
  Masses object(setup.experiment, 1);
  return courseOf(setup, {[&](const std::array<Hand, 2>& hands) {
                            object.step({hands[0], hands[1]});
                            std::array<double, 2> force{};
                            for (std::size_t h = 0; h < 2; ++h) force[h] = -object.forceOf(h, hands[h].x, hands[h].v, object.x, object.v);
                            return force;
                          },
                          [&](int) { return object.x; }, [&] { return 2 * squaresOf(object.v); }});
}

// A copy at each station, alone: the other hand comes `delay` ticks late and is moved on by its speed.
Course overLink(const TwoHandsSetup& setup, std::size_t delay) {
  std::array<Masses, 2> copies{Masses(setup.experiment, 1), Masses(setup.experiment, 1)};
  std::vector<std::array<Hand, 2>> sent;
  std::array<Hand, 2> guessed;
  return courseOf(setup, {[&](const std::array<Hand, 2>& hands) {
                            sent.push_back(hands);
                            std::array<double, 2> force{};
                            for (std::size_t h = 0; h < 2; ++h) {
                              Hand& other = guessed[1 - h];
                              other.x0 = other.x, other.v0 = other.v;
                              if (sent.size() > delay) {
                                const Hand& heard = sent[sent.size() - 1 - delay][1 - h];
                                other.x = heard.x + 1e-3 * static_cast<double>(delay) * heard.v, other.v = heard.v;
                              }
                              copies[h].step(h == 0 ? std::vector{hands[0], other} : std::vector{other, hands[1]});
                              force[h] = -copies[h].forceOf(h, hands[h].x, hands[h].v, copies[h].x, copies[h].v);
                            }
                            return force;
                          },
                          [&](int station) { return copies[static_cast<std::size_t>(station)].x; },
                          [&] { return squaresOf(copies[0].v) + squaresOf(copies[1].v); }});
}

double rms(const std::function<double(std::size_t)>& difference) {
  double sum = 0;
  for (std::size_t k = 0; k < 6499; ++k) sum += difference(k);
  return std::sqrt(sum / 6499);
}

TwoHandsSetup setupOf(SharedObject object) {
  TwoHandsSetup setup;
  setup.experiment = makeSharedExperiment(object, 400, 3, 1);
  setup.arm = {.mass = 1.5, .stiffness = 250, .damping = 30, .limpStiffness = 25, .limpDamping = 4};
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

TEST(TwoHands, TheirReferenceIsTheMotionThatIsDescribed) {
  for (const SharedObject object : kSharedObjects) {
    const TwoHandsSetup setup = setupOf(object);
    const Course expected = together(setup);
    const TwoHandsReference reference = makeReference(setup);
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

TEST(TwoHands, OverALinkEachCopyHearsTheOtherHandLate) {
  constexpr std::size_t kLate = 20;  // ticks
  for (const SharedObject object : kSharedObjects) {
    SCOPED_TRACE(testing::Message() << nameOf(object));
    TwoHandsSetup setup = setupOf(object);
    const Course reference = together(setup), expected = overLink(setup, kLate);
    const TwoHandsReference without = makeReference(setup);
    setup.roundTrip = 2e-3 * kLate;
    setup.jitterShare = -0.025;  // takes off what the link adds to every delay: half a millisecond either way
    const CopySettings alone{.frequency = 0, .ledger = false};
    const TwoHandsOutcome outcome = runTwoHands(setup, alone, without);
    ASSERT_GT(apartOf(expected), 1e-5);
    EXPECT_NEAR(outcome.apart, apartOf(expected), 0.03 * apartOf(expected));
    EXPECT_NEAR(outcome.forceError, forceErrorOf(expected, reference), 0.03 * forceErrorOf(expected, reference));
    EXPECT_NEAR(outcome.given, expected.given, 0.02 * std::abs(expected.given) + 1e-3);
    EXPECT_NEAR(outcome.growth, expected.growth, 0.05 * expected.growth);
    EXPECT_EQ(outcome.force, without.rms);
  }
}

// Dead reckoning alone lets a chain ring up over 100 ms, and a stiff one throws the hands over 200 ms.
TEST(TwoHands, WithoutSynchronisationAChainIsNotStable) {
  TwoHandsSetup setup;
  setup.experiment = makeSharedExperiment(SharedObject::Chain);
  setup.roundTrip = 0.1;
  const TwoHandsReference reference = makeReference(setup);
  const CopySettings alone{.frequency = 0, .ledger = false};
  EXPECT_FALSE(runTwoHands(setup, alone, reference).stable);
  EXPECT_TRUE(runTwoHands(setup, copySettingsFor(setup.experiment), reference).stable);
  setup.experiment = makeSharedExperiment(SharedObject::Chain, 2000);
  setup.roundTrip = 0.2;
  const TwoHandsOutcome thrown = runTwoHands(setup, alone, reference);
  EXPECT_FALSE(thrown.stable);
  EXPECT_TRUE(std::isinf(thrown.growth));
}

}  // namespace
}  // namespace reachlab::network
