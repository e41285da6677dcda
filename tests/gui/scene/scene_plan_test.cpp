#include "constraints/constraint.h"
#include "gui/scene_plan/scene_plan.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QFontMetricsF>
#include <QImage>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gui/scene/scene_overlay.h"
#include "gui/scene/trial_texts.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::scene {
namespace {

ScenePlan planOf(const char* experiment, ViewOptions::SideBySide wish = ViewOptions::SideBySide::Auto) {
  const experiment::Experiment e = experiment::readExperiment(experiment);
  return planScene(e, constraints::makeConstraint(e.constraint), {wish});
}

TEST(ScenePlan, PlacesWhereTheFormulaIsNotSmoothAreMarked) {
  const auto planFor = [](std::vector<std::string> curve, std::vector<std::string> surface) {
    experiment::Experiment e;
    e.object.masses = {1};
    e.constraint.name.clear();
    e.constraint.curve = std::move(curve);
    e.constraint.surface = std::move(surface);
    return planScene(e, constraints::makeConstraint(e.constraint));
  };
  const ScenePlan roof = planFor({"phi/10", "0.05*abs(phi - 1)", "0"}, {}), step = planFor({"phi/10", "0.05*sign(phi - 2)", "0"}, {});
  ASSERT_EQ(roof.places.size(), 1u);
  EXPECT_TRUE(roof.places[0].passed);
  EXPECT_NEAR(norm(roof.places[0].r - Vec3{0.1, 0, 0}), 0, 1e-12);
  ASSERT_EQ(step.places.size(), 1u);
  EXPECT_FALSE(step.places[0].passed);
  EXPECT_TRUE(planOf("ellipse").places.empty());
  const ScenePlan crease = planFor({}, {"u/10", "0.05*abs(u - v)", "v/10"});
  EXPECT_GE(crease.places.size(), 32u);
  for (const PlaceMark& mark : crease.places) EXPECT_NEAR(mark.r.x, mark.r.z, 1e-12);
}

TEST(ScenePlan, ParallelMassesAreShiftedForTheEyeAndAChainsAreNot) {
  const ScenePlan parallel = planOf("parallel"), chain = planOf("chain-moderate");
  Vec3 sum;
  for (const Vec3& shift : parallel.massShift) {
    EXPECT_GT(norm(shift), 0);
    sum += shift;
  }
  EXPECT_LT(norm(sum), 1e-15);  // rounding of two halves
  for (const Vec3& shift : chain.massShift) EXPECT_EQ(norm(shift), 0);
}

TEST(ScenePlan, EachOfSeveralHandsHasItsColourAndIsCoupledToWhatItHolds) {
  const experiment::Experiment e = experiment::readExperiment("chain-two-hands");
  const ScenePlan plan = planScene(e, constraints::makeConstraint(e.constraint), {.ownHand = 1});
  ASSERT_EQ(plan.hands.size(), 2u);
  EXPECT_GT(std::abs(plan.hands[0].green - plan.hands[1].green), 0.2);
  EXPECT_EQ(plan.colours.hand.green, plan.hands[1].green) << "the picture's own pen is the second hand's";
  ASSERT_EQ(plan.springs.size(), 6u);
  EXPECT_EQ(plan.springs[0].to, 0);
  EXPECT_EQ(plan.springs[0].hand, 0);
  EXPECT_EQ(plan.springs[1].to, 4);
  EXPECT_EQ(plan.springs[1].hand, 1);
  const SceneFrame rest = restingFrame(plan);
  EXPECT_EQ(rest.hands, (std::vector<std::optional<Vec3>>{plan.start, plan.start}));
  EXPECT_EQ(&ownHand(rest), &*rest.hands[1]);
  haptics::TickState both;  // at one station
  both.handCount = 2;
  both.hands[1].hip.position = {0.1, 0.2, 0.3};
  SceneFrame frame;
  copyToFrame(both, frame);
  EXPECT_EQ(frame.hands, (std::vector<std::optional<Vec3>>{Vec3{}, Vec3{0.1, 0.2, 0.3}}));
  SceneFrame second = rest;  // at the station of the second hand
  both.handCount = 1;
  copyToFrame(both, second);
  EXPECT_EQ(second.hands, (std::vector<std::optional<Vec3>>{std::nullopt, Vec3{}})) << "where the first is, is not known";
}

TEST(ScenePlan, MassesOverOneAnotherAreCountedUntilTheyPart) {
  const ScenePlan chain = planOf("chain-moderate");
  SceneFrame frame = restingFrame(chain);
  EXPECT_EQ(massesAtOnePlace(chain, frame), 5);
  frame.masses[0].x += 2 * chain.massRadius[0];
  EXPECT_EQ(massesAtOnePlace(chain, frame), 0);
  const ScenePlan apart = planOf("chain-moderate", ViewOptions::SideBySide::Always);
  EXPECT_EQ(massesAtOnePlace(apart, restingFrame(apart)), 0);
  const ScenePlan alone = planOf("dingwell");
  EXPECT_EQ(massesAtOnePlace(alone, restingFrame(alone)), 0);
}

TEST(ScenePlan, TheFloorLiesBelowAllMasses) {
  for (const char* name : {"chain-moderate", "parallel", "torus", "centre-out"}) {
    const ScenePlan plan = planOf(name, ViewOptions::SideBySide::Always);
    for (std::size_t i = 0; i < plan.massShift.size(); ++i)
      EXPECT_GT(plan.start.y + plan.massShift[i].y - plan.massRadius[i], plan.floor) << name << ", mass " << i;
  }
}

experiment::Experiment bareWith(experiment::Environment environment) {
  experiment::Experiment e = experiment::readExperiment("centre-out");  // from 0 to 0.1 m along -z in 0.6 s
  e.environment = std::move(environment);
  return e;
}

ScenePlan forcesPlan(const experiment::Experiment& e) { return planScene(e, constraints::makeConstraint(e.constraint), {.forces = true}); }

TEST(ForceMarks, AFieldIsDrawnAtThePeakSpeedOfAMinimumJerkReach) {
  const ScenePlan plan = forcesPlan(bareWith({{experiment::ViscousForce{{{{0, 0, 13}, {0, 0, 0}, {-13, 0, 0}}}}}}));
  const double speed = 1.875 * 0.1 / 0.6;  // Flash and Hogan 1985
  EXPECT_NEAR(plan.forces.speed, speed, 1e-12);
  ASSERT_EQ(plan.forces.field.size(), 30u);
  for (const ForceArrow& arrow : plan.forces.field) EXPECT_NEAR(norm(arrow.force - Vec3{-13 * speed, 0, 0}), 0, 1e-12) << "to the left";
  EXPECT_TRUE(plan.forces.channel.quads.empty());
  EXPECT_EQ(forcesText(plan.forces), QStringLiteral("Arrows: force at 0.313 m/s to the target, up to 4.06 N"));
}

TEST(ForceMarks, AnElasticForceIsDrawnWhereItActs) {
  const ScenePlan plan = forcesPlan(bareWith({{experiment::ElasticForce{{{{100, 0, 0}, {0, 0, 0}, {0, 0, 50}}}, Vec3{0.01, 0, 0}}}}));
  EXPECT_EQ(plan.forces.speed, 0);
  ASSERT_FALSE(plan.forces.field.empty());
  for (const auto& [at, force] : plan.forces.field)
    EXPECT_NEAR(norm(force - Vec3{-100 * (at.x - 0.01), 0, -50 * at.z}), 0, 1e-12) << at.x << ", " << at.z;
  EXPECT_TRUE(forcesText(plan.forces).startsWith(QStringLiteral("Arrows: force, up to ")));
}

TEST(ForceMarks, AJointFieldIsLeftOutWhereItsArmDoesNotReach) {
  experiment::Experiment e = bareWith({{experiment::JointViscousForce{{{{1.66, 0.64}, {0.64, -1.54}}}}}});
  e.arm.length = {0.33, 0.34};
  const std::size_t all = forcesPlan(e).forces.field.size();
  e.arm.shoulder = {0, -0.62};  // the target is 0.72 m away, and the arm 0.67 m long
  const std::vector<ForceArrow> near = forcesPlan(e).forces.field;
  EXPECT_LT(near.size(), all);
  EXPECT_FALSE(near.empty());
  for (const ForceArrow& arrow : near) EXPECT_LT(std::hypot(arrow.at.x, -arrow.at.z + 0.62), 0.67);
}

TEST(ForceMarks, AChannelHasItsWallsAndItsEndAndAPulseItsPlace) {
  experiment::PulseForce pulse{.force = {5, 0, 0}, .at = {.onset = {}, .distance = 0.04}};
  const ScenePlan plan = forcesPlan(bareWith({{experiment::ChannelForce{.halfWidth = 0.004, .breakDistance = 0.02}}, {pulse}}));
  ASSERT_EQ(plan.forces.channel.parameterLines.size(), 2u);
  for (const auto& wall : plan.forces.channel.parameterLines)
    for (const Vec3& p : wall) EXPECT_NEAR(std::abs(p.x), 0.004, 1e-12);
  for (const auto& dash : plan.forces.letsGo)
    for (const Vec3& p : dash) EXPECT_NEAR(std::abs(p.x), 0.02, 1e-12);
  for (const Vec3& p : plan.forces.channel.points) EXPECT_EQ(p.y, 0) << "in the plane of the task";
  ASSERT_EQ(plan.forces.pulses.size(), 1u);
  EXPECT_NEAR(norm(plan.forces.pulses[0].at - Vec3{0, 0, -0.04}), 0, 1e-12);
  EXPECT_TRUE(subjectsPlan(plan, {}).forces.pulses.empty()) << "the subject sees no force";
  EXPECT_TRUE(forcesText(subjectsPlan(plan, {}).forces).isEmpty());
  EXPECT_TRUE(forcesPlan(bareWith({})).forces.field.empty());
}

TEST(ScenePlan, ABlockIsSeenFromOneSideAndItsOtherTargetsAreFaint) {
  const experiment::Experiment e = bareWith({});
  std::vector<Vec3> block{{0, 0, 0}};
  for (int i = 0; i < 8; ++i)
    block.push_back({0.1 * std::cos(i * 0.25 * std::numbers::pi), 0, -0.1 * std::sin(i * 0.25 * std::numbers::pi)});
  experiment::Experiment right = e;
  right.task->target = {0.1, 0, 0};
  const constraints::Constraint free = constraints::makeConstraint(e.constraint);
  const ScenePlan ahead = planScene(e, free, {.blockPlaces = block}), aside = planScene(right, free, {.blockPlaces = block});
  EXPECT_EQ(ahead.seen, aside.seen);
  EXPECT_EQ(ahead.viewFrom, aside.viewFrom);
  EXPECT_EQ(ahead.massRadius, aside.massRadius);
  EXPECT_EQ(ahead.otherPlaces.size(), 7u);
  EXPECT_TRUE(subjectsPlan(ahead, {}).otherPlaces.empty());
  EXPECT_GT(planScene(e, free).viewFrom.y, 0.8) << "a bare hand on the table is seen from above";
}

TEST(ScenePlan, PlacesOnTheWayAreSeenByTheSubjectAndFadeOnceTheyArePassed) {
  experiment::Experiment e = bareWith({});
  e.task->via = {{0.05, 0, -0.05}, {0.3, 0, -0.05}};
  const ScenePlan plan = subjectsPlan(planScene(e, constraints::makeConstraint(e.constraint)), {});
  EXPECT_EQ(plan.via, e.task->via);
  EXPECT_EQ(std::count(plan.seen.begin(), plan.seen.end(), e.task->via[1]), 1) << "the picture holds it";
  haptics::TickState state;
  state.massCount = 1;
  SceneFrame before = restingFrame(plan), after = before;
  copyToFrame(state, before);
  state.viaPassed = 1;
  copyToFrame(state, after);
  EXPECT_TRUE(movedBeyond(1, before, after));
  EXPECT_TRUE(taskText(e, false).contains(QStringLiteral("2 balls on the way")));
}

TEST(TrialTexts, SayWhatTheSubjectCanUse) {
  using trial::Reason;
  const auto words = [](Reason reason, int mass, double by) {
    return outcomeText({trial::Outcome::Failure, reason, mass, by}).toStdString();
  };
  EXPECT_EQ(words(Reason::TimeShort, 0, 0.12), "Too fast by 0.12 s");
  EXPECT_EQ(words(Reason::Velocity, 5, 0.004), "Time is up: mass 5 still moves 4.0 mm/s too fast");
  EXPECT_EQ(words(Reason::Position, 0, 0.003), "Time is up: 3.0 mm too far from the target") << "a bare hand is no mass";
  experiment::Experiment e = bareWith({});
  EXPECT_TRUE(taskText(e, false).startsWith(QStringLiteral("Bring your hand to")));
  e.cursor = experiment::Cursor{};
  EXPECT_TRUE(taskText(e, false).startsWith(QStringLiteral("Bring the cursor to")));
  e.cursor->judge = experiment::CursorJudge::Hand;
  EXPECT_TRUE(taskText(e, false).startsWith(QStringLiteral("Bring your hand to")));
}

TEST(NumberList, ReadsBackWhatItShows) {
  for (const std::vector<double>& numbers : {std::vector<double>{0.6, 0.6, 0.6}, {1, 2.5e-7}, {600}, {}, {0.1 + 0.2, -3}})
    EXPECT_EQ(widgets::numbersOf(widgets::textOf(numbers)), numbers);
  EXPECT_EQ(widgets::textOf({0.6, 0.6, 0.6, 0.6, 0.6}), QStringLiteral("5 x 0.6"));
}

TEST(NumberList, RefusesWhatIsNoNumber) {
  for (const char* text : {"0,6", "abc", "1 nan", "inf", "3 x", "999999 x 1"})
    EXPECT_FALSE(widgets::numbersOf(QString::fromLatin1(text)).has_value()) << text;
}

TEST(Overlay, TheLongestSentenceFitsIntoTheSmallestScene) {
  const trial::TrialResult result{trial::Outcome::Failure, trial::Reason::Position, 12, 0.1279};
  QFont font = QApplication::font();
  font.setWeight(QFont::DemiBold);
  EXPECT_EQ(pointsToFit(QStringLiteral("Wait"), font, 19, {500, 32}), 19);
  for (const double room : {450.0, 600.0}) {  // [px] beside the square
    font.setPointSizeF(pointsToFit(outcomeText(result), font, 19, {room, 32}));
    EXPECT_LE(QFontMetricsF(font).horizontalAdvance(outcomeText(result)), room);
    EXPECT_GE(font.pointSizeF(), 9.5);
  }
}

// Pixels of ink side by side. Full blocks have more of them than points, so that they show whether the end of a text is seen.
int widestInk(const OverlayState& state, const QSize& size) {
  SceneOverlay overlay(nullptr);
  overlay.setTextScale(1.8);
  overlay.resize(size);
  overlay.setState(state);
  const QImage picture = overlay.grab().toImage();
  const QRgb ink = widgets::toQColor(widgets::colours::kText).rgb();
  int widest = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0, run = 0; x < picture.width(); ++x)
      widest = std::max(widest, run = (picture.pixel(x, y) | 0xff000000u) == ink ? run + 1 : 0);
  return widest;
}

const QString kBlocks = QString(8, QChar(0x2588));

TEST(Overlay, ALongInstructionIsSeenToItsEndOnASmallScreen) {
  OverlayState state;
  state.rulersShown = false;
  state.instruction = QString("... ").repeated(30) + kBlocks;
  EXPECT_GT(widestInk(state, {640, 512}), 7);
}

TEST(Overlay, LongInstructionsAreSeenToTheirEndBeforeABlockAndInARest) {
  const QString words = QString("... ").repeated(500) + kBlocks;
  OverlayState state;
  state.rulersShown = false;
  state.task = words;
  EXPECT_GT(widestInk(state, {1024, 768}), 7);
  state.task.clear();
  state.rest = RestState{QString(), words, 0, 1, 2};
  EXPECT_GT(widestInk(state, {1024, 768}), 7);
}

TEST(ScaleBar, IsRoundAndNotLongerThanItsRoom) {
  EXPECT_DOUBLE_EQ(roundLength(0.237), 0.2);
  EXPECT_DOUBLE_EQ(roundLength(0.099), 0.05);
  EXPECT_DOUBLE_EQ(roundLength(1.0), 1.0);
  EXPECT_EQ(roundLength(-1), 0);
}

}  // namespace
}  // namespace reachlab::gui::scene
