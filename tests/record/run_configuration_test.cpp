// Which configurations of a log are believed: every bound, everything that may miss, every default.
#include "sim/record/configuration/run_configuration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/experiment.h"
#include "tests/record/differing_keys.h"
#include "tests/record/made_run.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

json madeJson(int hands = 1) {
  RunConfiguration c = madeConfiguration();
  c.trials = {{0, 100, false}};
  c.participant.age = 30;
  if (hands > 1) {
    experiment::Experiment scene;
    scene.object.kind = experiment::ObjectKind::Chain;
    scene.object.masses.assign(2, 0.6);
    scene.hands.resize(static_cast<std::size_t>(hands));
    c.table = makeChannelTable(scene, 1);
    c.otherHands.resize(static_cast<std::size_t>(hands - 1));
  }
  return json::parse(toJson(c));
}

// What is said of it; "read" where nothing is.
std::string verdictOn(const json& j) {
  try {
    (void)configurationFromJson(j.dump(), "a log");
    return "read";
  } catch (const FaultError& refusal) {
    return refusal.what();
  }
}

std::string verdictWith(json j, const char* pointer, const json& value) {
  j[json::json_pointer(pointer)] = value;
  return verdictOn(j);
}

struct Bounds {
  const char* pointer;
  double least, most;
  const char* allowed;
};

// In the words of the refusal: "/trials/0/index" is trials[0].index.
std::string keyOf(std::string pointer) {
  std::string key = "configuration";
  for (std::size_t at = 0; at < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
    const std::string part = pointer.substr(at + 1, end - at - 1);
    key += std::isdigit(static_cast<unsigned char>(part[0])) ? "[" + part + "]" : "." + part;
    at = end;
  }
  return key;
}

void expectBounds(const json& good, const Bounds& b, const std::vector<json>& inside, const std::vector<json>& outside) {
  for (const json& value : inside)
    EXPECT_EQ(verdictWith(good, b.pointer, value).find(keyOf(b.pointer) + ": is"), std::string::npos) << b.pointer << " " << value;
  for (const json& value : outside)
    EXPECT_EQ(verdictWith(good, b.pointer, value), "a log: " + keyOf(b.pointer) + ": is " + value.dump() + "; allowed: " + b.allowed);
}

TEST(RunConfiguration, EveryWholeNumberReachesToItsBounds) {
  const json good = madeJson(2);
  ASSERT_EQ(verdictOn(good), "read");
  for (const Bounds& b : {Bounds{"/run", 1, 9999, "a whole number from 1 to 9999"},
                          {"/first_run", 1, 9999, "a whole number from 1 to 9999"},
                          {"/first_trial", 1, 1e7, "a whole number from 1 to 10000000"},
                          {"/block", 1, 1e7, "a whole number from 1 to 10000000"},
                          {"/day", 0, 1e7, "a whole number from 0 to 10000000"},
                          {"/sample_every_ticks", 1, 1e6, "a whole number from 1 to 1000000"},
                          {"/trials/0/index", 0, 1e7, "a whole number from 0 to 10000000"},
                          {"/trials/0/foreperiod_ms", 0, 1e9, "a whole number from 0 to 1000000000"},
                          {"/timing/max_missed_ticks", 0, 1e7, "a whole number from 0 to 10000000"},
                          {"/table/mass_count", 1, 512, "a whole number from 1 to 512"},
                          {"/table/parameter_count", 0, 3, "a whole number from 0 to 3"},
                          {"/table/hands", 1, 8, "a whole number from 1 to 8"}}) {
    const auto least = static_cast<std::int64_t>(b.least), most = static_cast<std::int64_t>(b.most);
    expectBounds(good, b, {least, most}, {least - 1, most + 1});
  }
}

TEST(RunConfiguration, EveryNumberReachesToItsBounds) {
  const json good = madeJson(2);
  for (const Bounds& b : {Bounds{"/pause_s", 0, 1e6, "a number from 0 to 1000000"},
                          {"/device_max_force_n", 0, 1e6, "a number from 0 to 1000000"},
                          {"/device_continuous_force_n", 0, 1e6, "a number from 0 to 1000000"},
                          {"/device_thermal_s", 1e-3, 1e6, "a number from 0.001 to 1000000"},
                          {"/sampling_hz", 1e-3, 1e6, "a number from 0.001 to 1000000"},
                          {"/participant/age_years", 0, 130, "a number from 0 to 130"},
                          {"/timing/max_gap_s", 0.001, 7200, "a number from 0.001 to 7200"},
                          {"/start_rest/rest_s", 0, 60, "a number from 0 to 60"},
                          {"/start_rest/rest_speed_m_per_s", 0, 1e6, "a number from 0 to 1000000"},
                          {"/guards/wall_radius_m", 0, 1000, "a number from 0 to 1000"},
                          {"/guards/wall_stiffness_n_per_m", 0, 1e6, "a number from 0 to 1000000"},
                          {"/guards/wall_damping_n_s_per_m", 0, 1e6, "a number from 0 to 1000000"},
                          {"/other_hands/0/max_force_n", 0, 1e6, "a number from 0 to 1000000"},
                          {"/other_hands/0/continuous_force_n", 0, 1e6, "a number from 0 to 1000000"},
                          {"/other_hands/0/thermal_s", 1e-3, 1e6, "a number from 0.001 to 1000000"}})
    expectBounds(good, b, {b.least, b.most}, {std::nextafter(b.least, -1e9), std::nextafter(b.most, 1e9)});
}

TEST(RunConfiguration, EveryListHasItsMost) {
  const json good = madeJson();
  const std::string list = "; allowed: a list of up to ";
  EXPECT_EQ(verdictWith(good, "/trials", 7), "a log: configuration.trials: is 7" + list + "10000000");
  EXPECT_EQ(verdictWith(good, "/other_hands", 7), "a log: configuration.other_hands: is 7" + list + "8");
  EXPECT_EQ(verdictWith(good, "/table/channels", std::vector<int>(10'001)),
            "a log: configuration.table.channels: is array" + list + "10000");
  EXPECT_EQ(verdictWith(good, "/table/channels", std::vector<int>(10'000)).find(list), std::string::npos);
  EXPECT_EQ(verdictWith(good, "/guards/wall_centre_m", json::array({1, 2, 3, 4})),
            "a log: configuration.guards.wall_centre_m: is array" + list + "3");
  for (const json& place : {json::array({1, 2}), json::array({1, "2", 3})})
    EXPECT_EQ(verdictWith(good, "/guards/wall_centre_m", place), "a log: configuration.guards.wall_centre_m: is not three numbers");
  EXPECT_EQ(verdictWith(good, "/guards", 5), "a log: configuration.guards: is no object");
}

TEST(RunConfiguration, EveryKeyMustBeThereButTheAge) {
  const json good = madeJson();
  for (const std::string where : {"", "/participant", "/table", "/table/channels/0", "/trials/0", "/timing", "/start_rest", "/guards"}) {
    const json::json_pointer place(where);
    for (const auto& [key, value] : good.at(place).items()) {
      json without = good;
      without.at(place).erase(key);
      EXPECT_EQ(verdictOn(without), key == "age_years" ? "read" : "a log: " + keyOf(where + "/" + key) + ": is missing");
    }
  }
  const json two = madeJson(2);
  for (const auto& [key, value] : two["other_hands"][0].items()) {
    json without = two;
    without["other_hands"][0].erase(key);
    EXPECT_EQ(verdictOn(without), "a log: configuration.other_hands[0]." + key + ": is missing");
  }
}

TEST(RunConfiguration, BeginsAsTheFirstRunOfASessionWithoutAPlan) {
  const RunConfiguration c;
  EXPECT_EQ(c.subject + c.session + c.task, "0101reach");
  for (const int one : {c.run, c.firstRun, c.firstTrial, c.block}) EXPECT_EQ(one, 1);
  EXPECT_EQ(c.day, 0);
  EXPECT_EQ(c.pauseSeconds, 0);
  for (const bool no : {c.practice, c.repeatAborted, c.virtualHand, c.rendersForce}) EXPECT_FALSE(no);
  for (const std::uint64_t seed : {c.seed, c.sessionSeed, c.orderSeed}) EXPECT_EQ(seed, 0u);
  EXPECT_EQ(c.deviceMaxForce, 0);
  EXPECT_EQ(c.clock, "steady");
  EXPECT_EQ(c.samplingHz, 100);
  EXPECT_EQ(c.sampleEveryTicks, 10u);
  const HandDevice hand;
  EXPECT_EQ(hand.maxForce + hand.continuousForce, 0);
  EXPECT_EQ(hand.thermalSeconds, 10);
  EXPECT_FALSE(hand.virtualHand || hand.rendersForce);
}

TEST(RunConfiguration, ALabelIsUpToSixtyLettersAndDigits) {
  for (const std::string& good : {std::string("0"), std::string("Az09"), std::string(60, 'a')}) EXPECT_FALSE(labelFault(good, "subject"));
  for (const std::string& bad : {std::string(), std::string("a-b"), std::string("ä"), std::string("a b"), std::string(61, 'a')}) {
    const auto fault = labelFault(bad, "subject");
    ASSERT_TRUE(fault) << bad;
    EXPECT_EQ(toText(*fault), "subject: \"" + bad + "\" is not a label; allowed: up to 60 letters and digits");
  }
  RunConfiguration c = madeConfiguration();
  c.subject = "a b", c.session = "c/d", c.task = "";
  try {
    checkConfiguration(c);
    FAIL();
  } catch (const FaultError& refusal) {
    EXPECT_EQ(refusal.faults.size(), 3u) << "each by itself";
  }
}

TEST(RunConfiguration, AnAgeIsZeroTo130YearsOrNotTold) {
  for (const std::optional<double>& good : {std::optional<double>{}, {0.0}, {30.5}, {130.0}})
    EXPECT_TRUE(problems({good, "F", "L"}).empty());
  for (const double bad : {-0.5, 130.5, std::nan("")}) EXPECT_FALSE(problems({bad, "", ""}).empty()) << bad;
  EXPECT_EQ(toText(problems({131, "", ""})), "participant.age: is 131; allowed: 0 to 130 years");
}

TEST(RunConfiguration, BehindTheScenesChannelsStandOnlyThoseOfStations) {
  RunConfiguration c = madeConfiguration();
  EXPECT_NO_THROW(checkConfiguration(c));
  Channel further = c.table.channels.back();
  const std::size_t scene = c.table.size();
  for (const char* name : {"station_gap", "station2_gap"}) {
    further.name = name;
    c.table.channels.push_back(further);
    EXPECT_NO_THROW(checkConfiguration(c)) << name;
  }
  c.table.channels.back().name = "hand_gap";
  try {
    checkConfiguration(c);
    FAIL();
  } catch (const FaultError& refusal) {
    EXPECT_EQ(std::string(refusal.what()), "table: has " + std::to_string(scene + 2) + " channels; allowed: " + std::to_string(scene) +
                                               ", as its masses and hands have");
  }
  c = madeConfiguration();
  c.table.channels.back().name = "station_gap";
  c.table.channels.pop_back();
  EXPECT_THROW(checkConfiguration(c), FaultError) << "one of the scene's is not there";
}

TEST(RunConfiguration, HasADeviceForEveryFurtherHandOfItsTable) {
  json j = madeJson(3);
  EXPECT_EQ(verdictOn(j), "read");
  j["other_hands"].erase(1);
  EXPECT_EQ(verdictOn(j), "a log: configuration.other_hands: has 1 hands; allowed: 2, as the table has");
  j = madeJson();
  EXPECT_NE(verdictWith(j, "/other_hands", madeJson(2)["other_hands"]), "read");
}

TEST(RunConfiguration, ThatDiffersIsToldByItsKeysInTheOrderOfTheList) {
  RunConfiguration a = madeConfiguration(), b = a;
  EXPECT_TRUE(differingKeys(a, b).empty());
  b.notes = "x", b.run = 2;
  b.participant.age = 20;
  EXPECT_EQ(differingKeys(a, b), (std::vector<std::string>{"notes", "participant", "run"}));
}

}  // namespace
}  // namespace reachlab::record
