// Which configurations of a log are believed: every bound, everything that may miss, every default.
#include "sim/record/configuration/run_configuration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

json madeJson(std::size_t hands = 1) {
  RunConfiguration c = madeConfiguration(2, hands);
  c.trials = {{0, 100, false}};
  c.participant.age = 30;
  return json::parse(toJson(c));
}

// What is said of it; "read" where nothing is.
std::string verdictOn(const json& j) {
  return refusalOf([&] { (void)configurationFromJson(j.dump(), "a log"); }, "read");
}

std::string verdictWith(json j, const char* pointer, const json& value) {
  j[json::json_pointer(pointer)] = value;
  return verdictOn(j);
}

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

TEST(RunConfiguration, ALabelIsUpToSixtyLettersAndDigits) {
  for (const std::string& good : {std::string("0"), std::string("Az09"), std::string(60, 'a')}) EXPECT_FALSE(labelFault(good, "subject"));
  for (const std::string& bad : {std::string(), std::string("a-b"), std::string("ä"), std::string("a b"), std::string(61, 'a')}) {
    const auto fault = labelFault(bad, "subject");
    ASSERT_TRUE(fault) << bad;
    EXPECT_EQ(toText(*fault), "subject: \"" + bad + "\" is not a label; allowed: up to 60 letters and digits");
  }
  RunConfiguration c = madeConfiguration();
  c.subject = "a b", c.session = "c/d", c.task = "";
  EXPECT_EQ(faultsToldBy([&] { checkConfiguration(c); }).size(), 3u) << "each by itself";
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
  EXPECT_EQ(refusalOf([&] { checkConfiguration(c); }),
            "table: has " + std::to_string(scene + 2) + " channels; allowed: " + std::to_string(scene) + ", as its masses and hands have");
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

}  // namespace
}  // namespace reachlab::record
