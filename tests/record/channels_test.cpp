#include "sim/record/configuration/channels.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

experiment::Experiment sceneOf(int masses, int hands = 1, experiment::ObjectKind kind = experiment::ObjectKind::Chain) {
  experiment::Experiment scene;
  scene.object.kind = kind;
  scene.object.masses.assign(static_cast<std::size_t>(masses), 0.6);
  if (hands > 1) scene.hands.resize(static_cast<std::size_t>(hands));
  return scene;
}

// A state of which no two numbers are equal, and what each channel is to show of it.
class Filled {
 public:
  explicit Filled(bool valid = true) : valid_(valid) {
    haptics::TickState& s = *state;
    s.tick = 1350;
    expected["latency"] = 1.35;
    s.measuredNs = 2'500'000'000;
    expected["measured_time"] = 2.5;
    hand(s.hands[0], "", "1");
    expected["energy"] = s.energy = another();
    expected["trial"] = s.trial = 7;
    s.phase = trial::Phase::Moving;
    expected["phase"] = 3;
    for (int i = 0; i < 3; ++i) {
      dynamics::MassState& mass = s.masses[static_cast<std::size_t>(i)];
      const std::string name = "mass" + std::to_string(i + 1);
      vector(name + "_pos", mass.r);
      vector(name + "_vel", mass.v);
      vector(name + "_acc", mass.a);
      for (std::size_t k = 0; k < 2; ++k) {
        expected[name + "_q" + std::to_string(k + 1)] = mass.q[k] = another();
        expected[name + "_q" + std::to_string(k + 1) + "_rate"] = mass.qRate[k] = another();
      }
    }
    for (std::size_t k = 0; k < 4; ++k) expected[std::string("body_quat_") + "wxyz"[k]] = s.body.orientation[k] = another();
    vector("body_gyro", s.body.angularVelocity);
    s.hasEnvironment = true;
    vector("environment_force", s.environment.force);
    vector("cursor_pos", s.environment.cursor);
    expected["port_energy"] = s.hands[0].portEnergy = another();
    expected["hand_work"] = s.hands[0].work = another();
    for (int i = 2; i <= 4; ++i) {
      haptics::HandState& other = s.hands[static_cast<std::size_t>(i - 1)];
      const std::string number = std::to_string(i);
      hand(other, number, number);
      expected["hand" + number + "_work"] = other.work = another();
    }
  }

  std::unique_ptr<haptics::TickState> state = std::make_unique<haptics::TickState>();  // large
  std::map<std::string, double> expected;

 private:
  double another() { return last_ += 0.125; }
  void vector(const std::string& name, Vec3& v) {
    v = {another(), another(), another()};
    expected[name + "_x"] = v.x, expected[name + "_y"] = v.y, expected[name + "_z"] = v.z;
  }
  // The first hand's columns have no number, the others' forces have theirs in front.
  void hand(haptics::HandState& h, const std::string& number, const std::string& whose) {
    const std::string force = number.empty() ? "" : "hand" + number + "_";
    vector("hand" + number + "_pos", h.hip.position);
    vector("hand" + number + "_vel", h.hip.velocity);
    vector("device" + number + "_pos", h.device.position);
    vector(force + "coupling_force", h.couplingForce);
    vector(force + "feedback_force", h.feedbackForce);
    vector(force + "device_force", h.deviceForce);
    h.device.valid = whose != "3" && (valid_ || whose != "1");
    expected[number.empty() ? "valid" : "hand" + number + "_valid"] = h.device.valid ? 1 : 0;
  }
  bool valid_;  // the first hand's sample
  double last_ = 100;
};

void expectRow(const ChannelTable& table, const Filled& filled) {
  EXPECT_EQ(rowWidth(table), table.size());
  std::vector<double> row(table.size() + 1, -1);
  fillRow(table, *filled.state, row.data());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto found = filled.expected.find(table.channels[i].name);
    ASSERT_NE(found, filled.expected.end()) << table.channels[i].name;
    EXPECT_EQ(row[i], found->second) << table.channels[i].name;
    EXPECT_EQ(table.indexOf(table.channels[i].name), i);
  }
  EXPECT_EQ(row.back(), -1) << "nothing behind the last channel is written";
}

TEST(Channels, ShowWhatTheirNamesSayInEveryScene) {
  const Filled filled;
  for (int parameters = 0; parameters <= 2; ++parameters)
    for (const int masses : {1, 3})
      for (const int hands : {1, 2, 4})
        for (const bool portEnergy : {false, true}) {
          SCOPED_TRACE(testing::Message() << parameters << " " << masses << " " << hands << " " << portEnergy);
          expectRow(makeChannelTable(sceneOf(masses, hands), parameters, portEnergy), filled);
        }
  for (const bool portEnergy : {false, true})
    expectRow(makeChannelTable(sceneOf(1, 1, experiment::ObjectKind::Body), 0, portEnergy), filled);
  expectRow(makeChannelTable(sceneOf(1), 0), Filled(false));
  for (const bool forces : {false, true})
    for (const bool cursor : {false, true}) {
      experiment::Experiment scene = sceneOf(0, 1, experiment::ObjectKind::None);
      if (forces) scene.environment = {{experiment::ChannelForce{}}};
      if (cursor) scene.cursor.emplace();
      for (const bool portEnergy : {false, true}) expectRow(makeChannelTable(scene, 0, portEnergy), filled);
    }
}

TEST(Channels, OfASceneAreAsManyAsItsPartsAskFor) {
  const auto width = [](const experiment::Experiment& scene, int parameters, bool portEnergy = false) {
    return makeChannelTable(scene, parameters, portEnergy).size();
  };
  EXPECT_EQ(width(sceneOf(1), 0), 24u + 9);
  EXPECT_EQ(width(sceneOf(5), 0), 24u + 5 * 9);
  EXPECT_EQ(width(sceneOf(5), 2), 24u + 5 * 13);
  EXPECT_EQ(width(sceneOf(1, 1, experiment::ObjectKind::Body), 0), 24u + 9 + 7);
  EXPECT_EQ(width(sceneOf(1), 0, true), 24u + 9 + 1);
  EXPECT_EQ(width(sceneOf(1, 3), 0), 24u + 9 + 1 + 2 * 20);
  experiment::Experiment bare = sceneOf(0, 1, experiment::ObjectKind::None);
  EXPECT_EQ(width(bare, 0), 24u);
  bare.environment = {{experiment::ChannelForce{}}};
  EXPECT_EQ(width(bare, 0), 24u + 3);
  bare.cursor.emplace();
  EXPECT_EQ(width(bare, 0), 24u + 6);
}

TEST(Channels, TellWhatOfTheSceneTheyAre) {
  const ChannelTable chain = makeChannelTable(sceneOf(3, 2), 1, true);
  EXPECT_EQ(chain.massCount, 3);
  EXPECT_EQ(chain.parameterCount, 1);
  EXPECT_FALSE(chain.body);
  EXPECT_TRUE(chain.portEnergy);
  EXPECT_EQ(chain.hands, 2);
  const ChannelTable body = makeChannelTable(sceneOf(1, 1, experiment::ObjectKind::Body), 0);
  EXPECT_TRUE(body.body);
  EXPECT_FALSE(body.portEnergy);
  EXPECT_EQ(body.hands, 1);
}

TEST(Channels, OneThatIsNotThereIsNamed) {
  EXPECT_EQ(refusalOf([&] { (void)makeChannelTable(sceneOf(1), 0).indexOf("mass2_pos_x"); }), "no channel named mass2_pos_x");
}

TEST(Channels, ATrialIsNumberedFromTheRunsFirst) {
  const ChannelTable table = makeChannelTable(sceneOf(2), 1);
  const std::size_t at = table.indexOf("trial");
  const auto numbered = [&](double engines, int first) {
    std::vector<double> row(table.size(), 5);
    row[at] = engines;
    numberTrial(table, first, row.data());
    for (std::size_t i = 0; i < row.size(); ++i) EXPECT_TRUE(i == at || row[i] == 5) << table.channels[i].name;
    return row[at];
  };
  EXPECT_EQ(numbered(1, 1), 1);
  EXPECT_EQ(numbered(1, 8), 8);
  EXPECT_EQ(numbered(3, 8), 10);
  EXPECT_EQ(numbered(0, 8), 0) << "before the first there is none";
}

}  // namespace
}  // namespace reachlab::record
