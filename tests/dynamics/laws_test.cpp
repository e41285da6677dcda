#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "tests/dynamics/make_experiment.h"

namespace reachlab::dynamics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kEnergyDrift = 1e-10;  // relative, over 10 s without friction

double momentOf(const Scene& scene) {
  const MassState mass = observed(*scene.plant)[0];
  return mass.r.x * mass.v.y - mass.r.y * mass.v.x;
}

// Clairaut: on a surface of revolution the moment of momentum about its axis stays.
TEST(Laws, ClairautHoldsOnSurfacesOfRevolution) {
  struct Case {
    const char *x, *y, *z;
    double v, rate;
  };
  for (const Case& c : {Case{"(0.1+0.04*cos(v))*cos(u)", "(0.1+0.04*cos(v))*sin(u)", "0.04*sin(v)", 0.5, 3},
                        Case{"0.1*cosh(v)*cos(u)", "0.1*cosh(v)*sin(u)", "0.1*v", -0.4, 0.5},
                        Case{"(0.1+0.02*sin(3*v))*cos(v)*cos(u)", "(0.1+0.02*sin(3*v))*cos(v)*sin(u)", "0.1*sin(v)", 0.2, 4}}) {
    const Scene scene = freeScene(onSurface(c.x, c.y, c.z), {0.1, c.v}, {2, c.rate});
    const double before = momentOf(scene);
    ASSERT_EQ(run(*scene.plant, noHand, 3), StepStatus::Ok) << c.x;
    EXPECT_NEAR(momentOf(scene) / before, 1, 1e-11) << c.x;
  }
}

// A sphere off the origin: after a hundred seconds the place is that of the great circle, and no equation of motion was solved.
TEST(Poles, WhereNothingPullsOnASphereItsGreatCircleIsFollowedInClosedForm) {
  const Scene scene = freeScene(onSurface("0.3+0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)-0.2", "0.1*sin(v)"), {0.3, 0.2}, {4, 1.5});
  const Vec3 middle{0.3, -0.2, 0};
  const MassState begin = observed(*scene.plant)[0];
  ASSERT_EQ(run(*scene.plant, noHand, 100), StepStatus::Ok);
  EXPECT_EQ(scene.plant->rhsEvaluations(), 0u);
  const double turn = norm(begin.v) / 0.1;
  const Vec3 expected = middle + std::cos(100 * turn) * (begin.r - middle) + (std::sin(100 * turn) / turn) * begin.v;
  EXPECT_LT(norm(observed(*scene.plant)[0].r - expected), 1e-12);
}

// Held, let go, held again, and let go with something that still pulls: as by sub-steps of the equations of motion.
TEST(Poles, LettingGoOnASphereAndTakingHoldAgainIsAsByTheEquationsOfMotion) {
  enum class Pull { Nothing, Force, Friction };
  for (const Pull pull : {Pull::Nothing, Pull::Force, Pull::Friction}) {
    experiment::Experiment e = onSurface("0.1*cos(u)*cos(v)", "0.1*sin(u)*cos(v)", "0.1*sin(v)");
    e.object.viscosity = pull == Pull::Friction ? 0.8 : 0;
    const auto hand = [](double t) { return HandSample{{0.1, 0.05 + 0.1 * t, 0.05 - 0.2 * t}, {0, 0.1, -0.2}, true}; };
    const auto place = [&](const char* method) {
      const Scene scene = compileScene(e, {method, 1e-3, 0});
      scene.plant->place(std::array{0.1, 0.2}, std::array{1.0, 0.5});
      if (pull == Pull::Force) scene.plant->setExtraForce({0, 0.4, 0.3});
      for (const bool held : {true, false, true, false}) {
        scene.plant->setCoupled(held);
        EXPECT_EQ(run(*scene.plant, hand, 0.4), StepStatus::Ok);
      }
      return observed(*scene.plant)[0];
    };
    const MassState ours = place("auto"), other = place("adaptive");
    EXPECT_LT(norm(ours.r - other.r), 1e-11) << static_cast<int>(pull);
    EXPECT_LT(norm(ours.v - other.v), 1e-10) << static_cast<int>(pull);
  }
}

// A body of revolution by a formula that is no quadric: near the pole it is followed in a polar chart.
TEST(Poles, AreFoundOnTheWayOnSurfacesOfAnyShape) {
  const char* radius = "(0.1+0.02*cos(2*v))";
  const std::string r = radius;
  for (const double sideways : {1e-2, 1e-5, 0.0}) {
    const Scene scene = freeScene(onSurface(r + "*cos(v)*cos(u)", r + "*cos(v)*sin(u)", r + "*sin(v)"), {0.3, 0.4}, {sideways, 2});
    const double before = scene.plant->energy({});
    const double momentBefore = momentOf(scene);
    ASSERT_EQ(run(*scene.plant, noHand, 4), StepStatus::Ok) << sideways;
    EXPECT_NEAR(scene.plant->energy({}) / before, 1, kEnergyDrift) << sideways;
    EXPECT_NEAR(momentOf(scene), momentBefore, 1e-12) << sideways;
  }
}

// The plane by polar parameters that wind k times round its pole while the angle runs through 2 pi. The law is a straight line.
TEST(Poles, ArePassedStraightWhateverTheParametersWinding) {
  for (const char* radius : {"v", "sinh(v)"})
    for (const double k : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
      for (const double offset : {0.0, 1e-9, 1e-8, 1e-7, 1e-3}) {
        SCOPED_TRACE(fmt::format("radius {}, {} windings, offset {}", radius, k, offset));
        Scene scene = freeScene(onSurface(fmt::format("0.1*{}*cos({}*u)", radius, k), fmt::format("0.1*{}*sin({}*u)", radius, k), "0"),
                                {0.3, 1}, {offset, -1});
        const bool plain = radius == std::string("v");
        const double r = plain ? 0.1 : 0.1 * std::sinh(1.0), slope = plain ? 0.1 : 0.1 * std::cosh(1.0);
        const double c = std::cos(0.3 * k), s = std::sin(0.3 * k), turn = r * k * offset;
        const Vec3 start{r * c, r * s, 0}, v{-slope * c - turn * s, -slope * s + turn * c, 0};
        ASSERT_EQ(run(*scene.plant, noHand, 1.6), StepStatus::Ok) << scene.plant->stopReason();
        EXPECT_LT(norm(observed(*scene.plant)[0].r - (start + 1.6 * v)), 1e-9);
      }
}

TEST(Cusps, AStartAtRestOnOneIsRefused) {
  EXPECT_THROW((void)compileScene(from(onCurve(makePoint(), "0.1*cos(phi)^3", "0.1*sin(phi)^3", "0"), {0}, {1})), RefusedError);
}

TEST(Starts, WhereNothingTellsTheWayAreRefusedWithTheirReason) {
  for (const auto& [name, start] : {std::pair<const char*, std::vector<double>>{"cone", {0, 0}}, {"whitney-umbrella", {0, 0}}}) {
    experiment::Experiment e = makePoint();
    e.constraint.name = name;
    const std::string told = refusalOf([&] { (void)compileScene(from(e, start, start)); });
    EXPECT_TRUE(holds(told, "no motion can begin at the start")) << name << ": " << told;
  }
}

TEST(Starts, OnAnEndAreWarnedOf) {
  for (const auto& [name, start, warned] : {std::tuple{"cycloid", 0.0, true}, {"parabola", -1.0, true}, {"parabola", -0.9, false}}) {
    experiment::Experiment e = makePoint();
    e.constraint.name = name;
    const std::vector<std::string> warnings = compileScene(from(e, {start}, {start})).choice.warnings;
    const bool told =
        std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) { return holds(w, "on an end of the constraint"); });
    EXPECT_EQ(told, warned) << name << start;
  }
}

TEST(Cusps, APointAtRestOnOneSaysThatNothingTellsWhereItGoes) {
  const Scene scene = compileScene(onCurve(makePoint(), "0.1*cos(phi)^3", "0.1*sin(phi)^3", "0"));
  scene.plant->placeAtRest(std::array{0.0});
  const HandSample hand{{0.05, 0.02, 0}, {}, true};  // it pulls along the tangent of the tip and across
  EXPECT_EQ(run(*scene.plant, hand, 0.1), StepStatus::NoContinuation);
  EXPECT_TRUE(holds(scene.plant->stopReason(), "cusp"));
  const MassState mass = observed(*scene.plant, hand)[0];
  EXPECT_TRUE(isFinite(mass.r) && isFinite(mass.v));
  EXPECT_LT(norm(mass.r - Vec3{0.1, 0, 0}), 1e-12) << "it has not moved";
}

// Huygens: on a cycloid hanging down the period is 4 pi sqrt(a/g) for any amplitude.
TEST(Laws, TheCycloidIsATautochrone) {
  const double a = 0.05, g = 9.81, quarter = kPi * std::sqrt(a / g);
  for (const double amplitude : {0.1, 1.0, 2.0}) {
    experiment::Experiment e = onCurve(makePoint(), "0.05*(phi+sin(phi))", "-0.05*cos(phi)", "0");
    e.object.gravity = {0, -g, 0};
    const int steps = 1000;
    const Scene scene = freeScene(e, {amplitude}, {0});
    ASSERT_EQ(run(*scene.plant, noHand, 5 * quarter, 5 * quarter / (5 * steps)), StepStatus::Ok);
    const MassState mass = observed(*scene.plant)[0];
    EXPECT_NEAR(mass.r.x, 0, 1e-9 * norm(mass.v) * quarter) << "period to 1e-9, amplitude " << amplitude;
  }
}

TEST(Ends, AnOpenCurveStopsOrBouncesAsItsDefinitionSays) {
  for (const bool bounce : {false, true}) {
    const auto e = onDefinition(makePoint(), "curve", R"(["0.1*phi", "0.1*phi^2", "0"])", "[-1.5, 1.5]", bounce ? "bounce" : "stop");
    const Scene scene = freeScene(e, {0.2}, {3});
    const double before = scene.plant->energy({});
    EXPECT_EQ(run(*scene.plant, noHand, 5), bounce ? StepStatus::Ok : StepStatus::AtEnd);
    EXPECT_TRUE(bounce || observed(*scene.plant)[0].q[0] == 1.5);
    EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-10);
  }
}

TEST(Ends, AreMetAtTheirMomentForAFewRightHandSides) {
  // Thrown up a cylinder whose ends are elastic, v goes up and down at constant speed: a triangle between -1 and 1.
  experiment::Experiment e = makePoint(0.5);
  e.constraint.name = "cylinder";
  const double rate = 7.3;
  const Scene scene = freeScene(e, {0.2, 0.4}, {3, rate});
  std::uint64_t before = scene.plant->rhsEvaluations(), most = 0;
  for (int i = 1; i <= 3000; ++i) {
    ASSERT_EQ(scene.plant->step(makeSegment(noHand, 0, 1e-3), 1e-3), StepStatus::Ok);
    most = std::max(most, scene.plant->rhsEvaluations() - before);
    before = scene.plant->rhsEvaluations();
    const double way = std::fmod(0.4 + 1 + rate * i * 1e-3, 4);  // from the lower end, there and back
    ASSERT_NEAR(observed(*scene.plant)[0].q[1], way < 2 ? way - 1 : 3 - way, 1e-10) << "after " << i << " ms of the default tolerance";
  }
  EXPECT_LT(most, 60u) << "the tick's step, the way to the end, four for its moment, the rest of the tick and a new start";
}

// A straight curve with ends goes by the propagator: where the masses of a chain meet one, they have the speeds they came with.
TEST(Ends, AChainOnALineMeetsItsEndWithItsSpeed) {
  const auto e = onDefinition(makeChain(3, 0.5, 400), "curve", R"(["0.1*phi", "0", "0"])", "[0, 2]", "stop");
  const Scene scene = freeScene(e, {1}, {3});
  EXPECT_EQ(scene.choice.method, "exact");
  EXPECT_EQ(run(*scene.plant, noHand, 1), StepStatus::AtEnd);
  for (const MassState& mass : observed(*scene.plant)) {
    EXPECT_NEAR(mass.r.x, 0.2, 1e-12);
    EXPECT_NEAR(mass.v.x, 0.3, 1e-12);
  }
}

// Straight on either side, so that the way from a corner is known.
TEST(Corners, AMassThatIsPutOnOneLeavesItTheWayItMoves) {
  for (const double rate : {-1.0, 1.0})
    for (const double at : {0.0, 1.0}) {
      const Scene scene = freeScene(onCurve(makePoint(), "phi/10", "0.05*abs(phi) + 0.03*abs(phi - 1)", "0"), {at}, {rate});
      ASSERT_EQ(run(*scene.plant, noHand, 0.1), StepStatus::Ok);
      const MassState mass = observed(*scene.plant)[0];
      EXPECT_NEAR(mass.q[0], at + 0.1 * rate, 1e-10);
      EXPECT_NEAR(mass.r.y, 0.05 * std::abs(mass.q[0]) + 0.03 * std::abs(mass.q[0] - 1), 1e-12);
    }
}

// Beside its corner such a curve is a straight line, along which a chain is pulled apart and damped as on any other.
TEST(Corners, AChainBesideOneMovesAsOnTheStraightLine) {
  experiment::Experiment straight = makeChain(3, 0.5, 400, {600, 5});
  straight.object.damping = {5, 2};
  const HandFunction hand = [](double t) {
    const MinimumJerk law = heldMinimumJerk(t / 0.8);
    return HandSample{{0.1 + 0.1 * law.value, 0.05 + 0.05 * law.value, 0}, law.rate / 0.8 * Vec3{0.1, 0.05, 0}, true};
  };
  const auto after = [&](const char* y) {
    const Scene scene = compileScene(onCurve(straight, "phi/10", y, "0"));
    scene.plant->placeAtRest(std::array{1.0});
    EXPECT_EQ(run(*scene.plant, hand, 0.5), StepStatus::Ok) << y;
    return observed(*scene.plant, hand(0.5));
  };
  const auto a = after("0.05*phi"), b = after("0.05*abs(phi)");
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT(norm(a[i].r - b[i].r), 1e-9) << i;
    EXPECT_LT(norm(a[i].v - b[i].v), 1e-8) << i;
  }
}

// However steep the curve becomes there.
TEST(Ends, AreMetFromEitherSideAlike) {
  for (const auto& [y, mirrored] : {std::pair{"sqrt(phi)/5", "sqrt(-phi)/5"},
                                    {"log(phi)/50", "log(-phi)/50"},
                                    {"phi^0.3/5", "(-phi)^0.3/5"},
                                    {"asin(phi - 1)/10", "asin(-phi - 1)/10"}}) {
    std::vector<MassState> met;
    std::vector<StepStatus> status;
    std::vector<double> fraction;
    for (const double side : {1.0, -1.0}) {
      const auto e = from(onCurve(makePoint(), "phi/10", side > 0 ? y : mirrored, "0"), {0.2 * side}, {0.4 * side});
      const Scene scene = freeScene(e, {0.2 * side}, {-2 * side});
      status.push_back(run(*scene.plant, noHand, 0.5));
      met.push_back(observed(*scene.plant)[0]);
      fraction.push_back(scene.plant->lastStepFraction());
    }
    EXPECT_EQ(status[0], status[1]) << y;
    EXPECT_NEAR(met[0].q[0], -met[1].q[0], 1e-9) << y;
    EXPECT_NEAR(met[0].r.y, met[1].r.y, 1e-9) << y;
    EXPECT_NEAR(fraction[0], fraction[1], 1e-6) << y;
  }
}

// On a surface of second degree, whose lines of u and v meet aslant: only the speed through the edge turns round.
TEST(Ends, AnElasticEdgeLeavesTheSpeedAlongIt) {
  const auto e = onDefinition(makePoint(), "surface", R"j(["0.1*u", "0.1*v", "0.05*(u^2 + v^2)"])j", "[[-1, 1], [-1, 1]]", "bounce");
  const Scene scene = freeScene(e, {0.5, 0.5}, {3, 0.5});
  EXPECT_TRUE(holds(scene.choice.form, "second degree"));
  MassState before = observed(*scene.plant)[0], after = before;
  for (int tick = 0; tick < 1000 && after.qRate[0] > 0; ++tick) {
    before = after;
    ASSERT_EQ(scene.plant->step(makeSegment(noHand, tick * 1e-3, 1e-3), 1e-3), StepStatus::Ok);
    after = observed(*scene.plant)[0];
  }
  ASSERT_LT(after.qRate[0], 0) << "it was thrown back";
  const auto alongEdge = [&](const MassState& mass) {
    const Vec3 edge = constraints::evaluate(scene.constraint->surface, mass.q[0], mass.q[1]).rV;
    return dot(mass.v, edge) / norm(edge);
  };
  EXPECT_NEAR(alongEdge(after), alongEdge(before), 5e-3) << "[m/s], of 0.3: what a tick's bend changes";
}

// A period joins what is one place; the two sides of a jump are two, and no `at_end` carries a mass across.
TEST(Ends, AJumpInAPeriodIsMetLikeAnEnd) {
  for (const bool bounce : {false, true}) {
    const auto e = onDefinition(makePoint(), "curve", R"j(["0.1*cos(phi)", "0.1*sin(phi)", "0.01*atan2(sin(phi), cos(phi))"])j",
                                R"(["-pi", "pi"])", bounce ? "bounce" : "stop", true);
    const Scene scene = freeScene(e, {3}, {1});
    const double before = scene.plant->energy({});
    const StepStatus status = run(*scene.plant, noHand, 0.3);
    const double phi = observed(*scene.plant)[0].q[0];
    EXPECT_NEAR(scene.plant->energy({}) / before, 1, 1e-12);
    if (bounce) {
      EXPECT_EQ(status, StepStatus::Ok);
      EXPECT_NEAR(phi, 2 * std::numbers::pi - 3.3, 1e-9) << "thrown back at pi: this helix is run evenly";
    } else {
      EXPECT_EQ(status, StepStatus::AtEnd);
      EXPECT_NEAR(phi, std::numbers::pi, 1e-9);
      EXPECT_TRUE(holds(scene.plant->stopReason(), "never crossed: jump at phi = 3.14159265"));
    }
  }
}

// Euler's top, its axes of inertia turned against the body's: what nothing turns keeps R I R^T omega in the world.
TEST(Body, OfAnyInertiaKeepsItsAngularMomentum) {
  const experiment::Experiment e = makeBody();
  const Scene scene = freeScene(e, {0, 0, 0}, {0, 0, 0});
  scene.plant->setAngularVelocity({1, 2, 3});
  const auto momentum = [&] {
    const BodyState body = scene.plant->body();
    const auto& [w, x, y, z] = body.orientation;
    const std::array<Vec3, 3> axes{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},  // the body's, in the world
                                   Vec3{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                                   Vec3{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum += e.object.inertia[i][j] * dot(axes[j], body.angularVelocity) * axes[i];
    return sum;
  };
  const Vec3 before = momentum();
  const Vec3 turn = scene.plant->body().angularVelocity;
  ASSERT_EQ(run(*scene.plant, noHand, 2), StepStatus::Ok);
  EXPECT_LT(norm(momentum() - before), 1e-10 * norm(before));
  EXPECT_GT(norm(scene.plant->body().angularVelocity - turn), 0.1) << "it tumbles";
}

}  // namespace
}  // namespace reachlab::dynamics
