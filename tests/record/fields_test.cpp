#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/fault.h"
#include "sim/record/configuration/run_fields.h"
#include "tests/record/configuration_keys.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {

// A struct as a later version might have it: `added` is new.
struct Example {
  int old = 1;
  std::optional<double> added;
};
template <MaybeConst<Example> T, class Visit>
void visitFields(T& e, const Visit& visit) {
  visit(Field{"old", 0, 9}, e.old);
  visit(Field{"added_m", 0, 10}, e.added);
}

namespace {

using nlohmann::json;

TEST(Fields, OneThatIsAddedToTheListIsReadAndWritten) {
  const Example written{3, 7.25};
  EXPECT_EQ(writeFields(written), (json{{"old", 3}, {"added_m", 7.25}}));
  Example read;
  readFields(json{{"old", 3}, {"added_m", 7.25}}, read);
  EXPECT_EQ(read.added, 7.25);
  Example earlier;
  readFields(json{{"old", 3}}, earlier);
  EXPECT_FALSE(earlier.added) << "recordings of earlier versions do not have it";
  EXPECT_THROW(readFields(json{{"added_m", 7.25}}, earlier), FaultError) << "what was always there is missing";
  EXPECT_THROW(readFields(json{{"old", 3}, {"added_m", 11}}, earlier), FaultError) << "out of its bounds";
}

// Converts to anything, so that a struct of n members can be made from n of it, and not from n + 1.
struct Anything {
  template <class T>
  operator T() const;
};
template <class T, class... Members>
consteval std::size_t countMembers() {
  if constexpr (requires { T{Members{}..., Anything{}}; }) return countMembers<T, Members..., Anything>();
  else return sizeof...(Members);
}
template <class T>
std::size_t countFields(const T& value) {
  std::size_t count = 0;
  visitFields(value, [&](const Field&, const auto&) { ++count; });
  return count;
}

TEST(Fields, EveryMemberOfAConfigurationStandsInTheList) {
  const std::size_t firstHand = countFields(haptics::DeviceInfo{});  // each member of the device has a key of the configuration
  EXPECT_EQ(countFields(RunConfiguration{}), countMembers<RunConfiguration>() - 1 + firstHand);
  EXPECT_EQ(countFields(Participant{}), countMembers<Participant>());
  EXPECT_EQ(countFields(ChannelTable{}), countMembers<ChannelTable>());
  EXPECT_EQ(countFields(Channel{}), countMembers<Channel>());
  EXPECT_EQ(countFields(trial::PlannedTrial{}), countMembers<trial::PlannedTrial>());
  EXPECT_EQ(countFields(RunScene{}), countMembers<RunScene>());
  EXPECT_EQ(countFields(haptics::GuardSettings{}), countMembers<haptics::GuardSettings>());
  EXPECT_EQ(countFields(experiment::StartRest{}), countMembers<experiment::StartRest>());
  EXPECT_EQ(countFields(experiment::TimingLimits{}), countMembers<experiment::TimingLimits>());
}

void change(std::string& x) { x += "x"; }
void change(bool& x) { x = !x; }
void change(double& x) { x += 0.5; }
template <std::integral T>
void change(T& x) {
  ++x;
}
void change(Participant& x) { x.age = x.age.value_or(30) + 1; }
void change(experiment::TimingLimits& x) { --x.maxMissedTicks; }  // the default is the largest
void change(haptics::GuardSettings& x) { x.wallCentre.y += 0.5; }
void change(experiment::StartRest& x) { x.seconds += 0.5; }
void change(ChannelTable& x) { x.channels.front().description += "x"; }
void change(std::vector<trial::PlannedTrial>& x) { x.push_back({5, 100, true}); }
void change(std::optional<std::vector<RunScene>>& x) { x.emplace().push_back({"field", "3", "field 3", "{}", "rk4", ""}); }
void change(std::vector<haptics::DeviceInfo>& x) { x.emplace_back().name = "simulated"; }

// Each field in turn is changed, goes through the text, and is the only one that differs.
TEST(Fields, OfAConfigurationComeBackFromItsTextEachByItself) {
  const RunConfiguration original = madeConfiguration();
  std::size_t number = 0;
  visitFields(original, [&](const Field& field, const auto&) {
    RunConfiguration changed = original;
    std::size_t at = 0;
    visitFields(changed, [&](const Field&, auto& member) {
      if (at++ == number) change(member);
    });
    std::vector<std::string> expected{field.key};
    if (!changed.otherHands.empty()) {  // a hand has columns
      changed.table = madeConfiguration(original.table.massCount, 2).table;
      expected.emplace_back("table");
    }
    ++number;
    const RunConfiguration read = configurationFromJson(toJson(changed), "changed");
    EXPECT_TRUE(differingKeys(changed, read).empty()) << field.key;
    EXPECT_EQ(differingKeys(original, read), expected);
  });
  EXPECT_GT(number, 40u);
}

// A log of one scene stays as it was.
TEST(Fields, ANumberThatIsLeftOutAtZeroIsReadAsZero) {
  RunConfiguration c = madeConfiguration();
  c.trials = {{0, 100, false}, {1, 100, false, 1}};
  c.scenes.emplace(2);
  const json written = json::parse(toJson(c));
  EXPECT_FALSE(written["trials"][0].contains("scene"));
  EXPECT_EQ(written["trials"][1]["scene"], 1);
  const RunConfiguration read = configurationFromJson(toJson(c), "a log");
  EXPECT_EQ(read.trials[0].scene, 0);
  EXPECT_EQ(read.trials[1].scene, 1);
}

// What a later version means by the same keys is not known.
TEST(RunConfiguration, OfAnotherVersionIsRefused) {
  nlohmann::json written = nlohmann::json::parse(toJson(RunConfiguration{}));
  for (const nlohmann::json& version : {nlohmann::json(2), nlohmann::json(1e300), nlohmann::json("1"), nlohmann::json(nullptr)}) {
    written["schema_version"] = version;
    EXPECT_EQ(refusalOf([&] {
                configurationFromJson(written.dump(), "a log");
              }).find("a log: configuration.schema_version: is " + version.dump() + "; allowed: 1"),
              0u);
  }
}

}  // namespace
}  // namespace reachlab::record
