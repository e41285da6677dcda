#include "devices/replay/replayed_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <filesystem>

#include "base/error.h"
#include "base/fault.h"
#include "sim/experiment/resources.h"
#include "test_paths.h"
#include "tests/in_a_folder.h"
#include "tests/refusal.h"

namespace reachlab::devices {
namespace {

const std::string kReaches = REACHLAB_SOURCE_DIR "/resources/reaches";

class Files : public InAFolder {};

// A curved reach in a frame of its own: chord of 0.5 m, a detour of 5 cm, overshoot and return at the end, uneven times.
RecordedReach curvedReach() {
  RecordedReach reach;
  for (int i = 0; i <= 80; ++i) {
    const double t = (i + 0.3 * std::sin(i)) / 80, x = 0.5 * std::sin(1.8 * t);
    reach.time.push_back(t);
    reach.position.push_back({2 + 0.05 * std::sin(3 * t), -1 + x, 0.3});
  }
  return reach;
}

TEST(ReplayedReach, KeepsTheShapeOfTheReachUpToScale) {
  const RecordedReach reach = curvedReach();
  const Vec3 start{-0.1, 0.02, 0}, target{0.1, 0.02, 0.01};
  const subjects::PlayedReach played = layOnto(reach, start, target);
  const Vec3 first = reach.position.front();
  double chord = 0;
  for (const Vec3& p : reach.position) chord = std::max(chord, norm(p - first));
  const double scale = norm(target - start) / chord;
  for (std::size_t i = 20; i + 1 < reach.time.size(); ++i) {  // the last one is held, not passed
    const double tick = (0.3 + reach.time[i]) * 1000;
    const auto k = static_cast<std::size_t>(tick);
    if (k + 1 >= played.position.size()) break;
    const Vec3 at = played.position[k] + (tick - static_cast<double>(k)) * (played.position[k + 1] - played.position[k]);
    // A chord of 1 ms cuts a corner of less than a (1 ms)^2/8, with a < 20 m/s^2 scaled.
    EXPECT_NEAR(norm(at - start), scale * norm(reach.position[i] - first), 3e-6);
  }
}

TEST(ReplayedReach, LaysTheFarthestSampleOnTheTarget) {
  const Vec3 start{0.01, -0.1, 0.02}, target{0.03, 0.1, -0.05};
  for (const double sign : {1.0, -1.0}) {
    RecordedReach reach;
    for (int i = 0; i <= 100; ++i) reach.time.push_back(0.01 * i), reach.position.push_back(sign * 0.004 * i * Vec3{0.2, 2, -0.7});
    const subjects::PlayedReach played = layOnto(reach, start, target);
    EXPECT_NEAR(norm(played.position.back() - target), 0, 1e-12) << "rounding of the rotation";
  }
}

TEST(ReplayedReach, AllHumanReachesStartAtTheStartAndPassTheTarget) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kReaches)) {
    if (entry.path().extension() != ".csv") continue;
    ++files;
    const subjects::PlayedReach played = layOnto(readReach(entry.path().string()), {-0.1, 0, 0}, {0.1, 0, 0});
    double nearest = 1;
    for (const Vec3& p : played.position) nearest = std::min(nearest, norm(p - Vec3{0.1, 0, 0}));
    EXPECT_LT(nearest, 1e-3) << entry.path();  // the sample lies between two ticks
  }
  EXPECT_EQ(files, 19);
}

TEST_F(Files, AFolderIsPlayedInNameOrderAndFromTheFirstAgain) {
  folder_.write("b.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n0.2,1,0,0\n");
  folder_.write("a.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n0.1,1,0,0\n");
  const auto device = makeReplayHand(folder_.path(), {0, 0, 0}, {1, 0, 0});
  const auto ticksOf = [&](int trial) {
    device->prepareTrial(trial);
    device->cue(haptics::Cue::Place);
    device->cue(haptics::Cue::Go);
    int ticks = 0;
    while (device->read().position.x < 1 - 1e-9) ++ticks;
    return ticks;
  };
  const int a = ticksOf(0), b = ticksOf(1);
  EXPECT_NEAR(b - a, 100, 1);
  EXPECT_EQ(ticksOf(2), a);
}

TEST_F(Files, SaysWhatIsWrongWithAFile) {
  EXPECT_THROW(readReach((folder_ / "missing.csv").string()), ResourceError);
  const auto missing = [&] { makeReplayHand((folder_ / "missing").string(), {}, {1, 0, 0}); };
  EXPECT_TRUE(holds(reachlab::refusalOf(missing), experiment::resourceFolder() + "/reaches"));
  EXPECT_THROW(makeReplayHand(folder_.path(), {}, {1, 0, 0}), ResourceError) << "an empty folder";
}

// A line at constant speed, uneven in time: the spline is the line itself. At rest for 0.3 s, blended onto it over 0.1 s, held at its end.
TEST(ReplayedReach, ALineIsPlayedAsItIsAfterItsRestAndItsJoin) {
  RecordedReach reach;
  const Vec3 speed{0.4, 0.3, 0};
  for (const double t : {5.0, 5.1, 5.25, 5.3, 5.6, 5.8}) reach.time.push_back(t), reach.position.push_back(Vec3{7, 8, 9} + t * speed);
  const Vec3 start{0.02, 0.01, -0.03}, target = start + Vec3{0, 0.8, 0};  // twice as long, along y
  const subjects::PlayedReach played = layOnto(reach, start, target);
  ASSERT_EQ(played.position.size(), 1101u) << "0.3 s and 0.8 s";
  EXPECT_TRUE(played.velocity.empty());
  for (std::size_t i = 0; i < played.position.size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i) - 0.3, s = std::clamp(t / 0.1, 0.0, 1.0);
    const double blend = s * s * s * (10 + s * (6 * s - 15)), way = std::clamp(t, 0.0, 0.8);
    ASSERT_LT(norm(played.position[i] - start - blend * way * Vec3{0, 1, 0}), 1e-12) << i;
  }
}

// By the smallest rotation: what lies across both chords keeps its direction, and it is scaled as all is.
TEST(ReplayedReach, IsTurnedByTheSmallestRotation) {
  const RecordedReach reach{"turned.csv", {0, 0.5, 1}, {{0, 0, 0}, {0.2, 0, 0.1}, {0.4, 0, 0}}};
  const subjects::PlayedReach played = layOnto(reach, {0, 0, 0}, {0, 0.2, 0});
  EXPECT_LT(norm(played.position[800] - Vec3{0, 0.1, 0.05}), 1e-12);
  const RecordedReach back{"back.csv", {0, 0.5, 1}, {{0, 0, 0}, {-0.2, 0.05, 0.03}, {-0.4, 0, 0}}};
  const subjects::PlayedReach turned = layOnto(back, {-0.1, 0, 0}, {0.3, 0, 0});
  EXPECT_NEAR(turned.position[800].x, 0.1, 1e-12);
  EXPECT_NEAR(std::hypot(turned.position[800].y, turned.position[800].z), std::hypot(0.05, 0.03), 1e-12);
  const RecordedReach down{"down.csv", {0, 0.5, 1}, {{0, 0, 0}, {0.01, -0.2, 0}, {0, -0.4, 0}}};
  const subjects::PlayedReach up = layOnto(down, {0, 0, 0}, {0, 0.4, 0});
  EXPECT_NEAR(up.position[800].y, 0.2, 1e-12);
  EXPECT_NEAR(std::hypot(up.position[800].x, up.position[800].z), 0.01, 1e-12);
}

TEST(ReplayedReach, WhatCannotBeLaidIsRefusedInWords) {
  const auto refusalOf = [](const RecordedReach& reach, const Vec3& start = {}, const Vec3& target = {1, 0, 0}) {
    return reachlab::refusalOf([&] { (void)layOnto(reach, start, target); }, "laid");
  };
  EXPECT_EQ(refusalOf({"f", {0, 600}, {{}, {1, 0, 0}}}), "laid");
  EXPECT_EQ(refusalOf({"f", {1, 601.5}, {{}, {1, 0, 0}}}), "f: time_s: lasts 600.5 s; allowed: a reach of at most 600 s");
  EXPECT_EQ(refusalOf({"f", {0}, {{}}}), "f: fewer than two samples");
  EXPECT_EQ(refusalOf({"f", {0, 1}, {{1, 1, 1}, {1, 1, 1}}}), "f: the hand does not move");
  EXPECT_EQ(refusalOf({"f", {0, 1}, {{}, {1, 0, 0}}}, {1, 0, 0}),
            "task.target: start and target are the same position; allowed: two positions");
}

TEST_F(Files, AReplayIsNamedAndMovesByTickCount) {
  const auto device = makeReplayHand(folder_.write("a.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n0.1,1,0,0\n"), {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(device->info().name, "replay");
  EXPECT_EQ(device->info().version, "1");
  EXPECT_TRUE(device->info().virtualHand);
  EXPECT_FALSE(device->read().hasVelocity) << "left to the estimator";
}

}  // namespace
}  // namespace reachlab::devices
