#include "devices/haply/haply_device.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "base/fault.h"
#include "devices/driver/registry.h"
#include "devices/haply/web_socket_link.h"
#include "devices/make_device.h"
#include "sim/experiment/experiment.h"
#include "tests/devices/fakes/fake_haply.h"
#include "tests/devices/fakes/fake_message_line.h"
#include "tests/refusal.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::FakeHaply;
using test::until;

std::unique_ptr<haptics::HapticDevice> openHaply(const FakeHaply& service, const std::string& id = "") {
  return makeDevice(fmt::format("haply:{}{}port={}", id, id.empty() ? "" : ",", service.port()), experiment::readExperiment("chain-slow"),
                    1);
}

std::string refusalOfHaply(const FakeHaply& service, const std::string& id = "") {
  return refusalOf([&] { openHaply(service, id); }, "it was opened");
}

TEST(HaplyMessage, PlacesAndForcesKeepTheirAxes) {
  const Vec3 device{1, 2, 3};  // 2 away from the user, 3 up
  EXPECT_EQ(haplyToWorld(device), (Vec3{1, 3, -2}));
  EXPECT_EQ(worldToHaply(haplyToWorld(device)), device);
  const Vec3 force{4, 5, 6};
  EXPECT_EQ(dot(worldToHaply(force), device), dot(force, haplyToWorld(device))) << "the same work in both frames";
}

TEST(HaplyMessage, TheCommandIsThePublishedOne) {
  EXPECT_EQ(haplyForceCommand("049D", {0.5, -1, 0}),
            R"({"inverse3":[{"commands":{"set_cursor_force":{"values":{"x":0.5,"y":-1.0,"z":0.0}}},"device_id":"049D"}]})");
}

TEST(HaplyMessage, AForceThatIsNoNumberIsNone) { EXPECT_EQ(haplyForceCommand("1", {NAN, 1, 1}), haplyForceCommand("1", {})); }

TEST(HaplyMessage, WhatIsNoStateIsNotBelieved) {
  HaplyState state;
  const auto ofA = [](const std::string& told) { return R"({"inverse3":[{"device_id":"A","state":)" + told + "}]}"; };
  for (const auto& [message, answer] : {std::pair<std::string, HaplyAnswer>{"", HaplyAnswer::NotJson},
                                        {"[1, 2]", HaplyAnswer::NotJson},
                                        {"{}", HaplyAnswer::NoDevice},
                                        {R"({"session":1})", HaplyAnswer::OtherVersion},
                                        {R"({"inverse3": {"049D": {}}})", HaplyAnswer::OtherVersion},
                                        {R"({"inverse3": []})", HaplyAnswer::NoDevice},
                                        {R"({"inverse3":[{"name":"A"}]})", HaplyAnswer::OtherVersion},
                                        {R"({"inverse3":[{"device_id":"A"}]})", HaplyAnswer::OtherVersion},
                                        {ofA("{}"), HaplyAnswer::OtherVersion},
                                        {ofA(R"({"place":{"x":1}})"), HaplyAnswer::OtherVersion},
                                        {ofA(R"({"cursor_position":{"x":"left"}})"), HaplyAnswer::NotJson},
                                        {ofA(R"({"cursor_position":{"x":1e999}})"), HaplyAnswer::NotJson}})
    EXPECT_EQ(readHaplyMessage(message, "", state), answer) << message;
  const std::string raised = ofA(R"({"cursor_position":{"z":0.1}})");
  EXPECT_EQ(readHaplyMessage(raised, "B", state), HaplyAnswer::NoDevice);
  ASSERT_EQ(readHaplyMessage(raised, "", state), HaplyAnswer::State);
  EXPECT_EQ(state.position, (Vec3{0, 0, 0.1})) << "what is left out is zero";
}

HaplyState stateIn(const std::string& message, const std::string& id = "", const std::string& grip = "") {
  HaplyState state;
  state.buttons = 99;
  EXPECT_EQ(readHaplyMessage(message, id, state, grip), HaplyAnswer::State) << message;
  return state;
}

TEST(HaplyMessage, AStateIsOfTheDeviceThatIsAskedFor) {
  const std::string two = R"({"inverse3":[7,{"device_id":""},{"device_id":"A","state":{"cursor_position":{"x":1,"y":2,"z":3}}},
    {"device_id":"B","state":{"cursor_position":{"x":4},"cursor_velocity":{"y":5}}}]})";
  EXPECT_EQ(stateIn(two).id, "A") << "the first that has a name";
  EXPECT_EQ(stateIn(two).position, (Vec3{1, 2, 3}));
  EXPECT_FALSE(stateIn(two).velocity);
  EXPECT_EQ(stateIn(two).buttons, 0u);
  EXPECT_EQ(stateIn(two, "B").id, "B");
  EXPECT_EQ(stateIn(two, "B").position, (Vec3{4, 0, 0}));
  EXPECT_EQ(stateIn(two, "B").velocity, (Vec3{0, 5, 0}));
  EXPECT_EQ(readHaplyService(two).devices, (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(readHaplyService("{}").devices.empty());
  EXPECT_TRUE(readHaplyService(R"({"inverse3":{}})").devices.empty());
  for (const char* key : {"cursor_velocity", "current_cursor_force", "current_cursor_position", "body_orientation", "control_mode",
                          "control_domain", "angular_position", "angular_velocity", "transform", "mode"})
    EXPECT_EQ(stateIn(fmt::format(R"({{"inverse3":[{{"device_id":"A","state":{{"{}":1}}}}]}})", key)).position, Vec3{}) << key;
}

// The grip of that name, wireless or on a cable; without a name the only one.
TEST(HaplyMessage, AGripsButtonsAreOfTheOneThatIsHeld) {
  const auto with = [](const std::string& grips) {
    return R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{}}}],)" + grips + "}";
  };
  const std::string one = R"({"device_id":"g1","state":{"buttons":{"a":false,"b":true,"c":true}}})";
  const std::string other = R"({"device_id":"g2","state":{"buttons":{"a":true,"b":1}}})";
  EXPECT_EQ(stateIn(with(R"("wireless_verse_grip":[3,)" + one + "]")).buttons, 0b110u);
  const std::string both = with(R"("wireless_verse_grip":[)" + one + R"(],"verse_grip":[)" + other + "]");
  EXPECT_EQ(stateIn(both).buttons, 0u) << "none of two";
  EXPECT_EQ(stateIn(both, "", "g2").buttons, 1u) << "a number is no button that is pressed";
  EXPECT_EQ(stateIn(both, "", "g3").buttons, 0u);
  EXPECT_EQ(readHaplyService(both).grips, (std::vector<std::string>{"g1", "g2"}));
  EXPECT_TRUE(readHaplyService("[]").grips.empty());
}

TEST(HaplyMessage, WhatOfItsConfigurationIsFeltIsToldInItsWords) {
  const std::string message =
      R"({"inverse3":[{"device_id":"A","config":{"filters":{"force":1},"handedness":"left","gravity_compensation":true}},{"device_id":"B"}]})";
  EXPECT_EQ(readHaplyService(message, "A").settings, R"(gravity_compensation true, filters {"force":1})");
  EXPECT_EQ(readHaplyService(message, "").settings, readHaplyService(message, "A").settings);
  EXPECT_EQ(readHaplyService(message, "B").settings, "");
  EXPECT_EQ(readHaplyService(message, "C").settings, "");
  EXPECT_EQ(readHaplyService("{}", "A").settings, "");
  EXPECT_EQ(haplyGreeting(), R"({"session":{"configure":{"profile":{"name":"reachlab"}}}})");
}

class HaplyOverALine : public ::testing::Test {
 protected:
  static std::string stateAt(double x, const std::string& more = "") {
    return fmt::format(R"({{"inverse3":[{{"device_id":"A","state":{{"cursor_position":{{"x":{}}}{}}}}}]}})", x, more);
  }
  HaplyInverse3 open(const HaplyInverse3::Options& options = {}) {
    if (line->waiting.empty()) line->waiting = {stateAt(0)};
    HaplyInverse3 device(options, [this] { return std::make_unique<test::FakeMessageLink>(line); });
    line->waits.clear();
    return device;
  }
  std::string refusalOf(const HaplyInverse3::Options& options = {}) {
    return reachlab::refusalOf<ResourceError>(
        [&] { HaplyInverse3(options, [this] { return std::make_unique<test::FakeMessageLink>(line); }); }, "opened");
  }
  std::shared_ptr<test::FakeMessageLine> line = std::make_shared<test::FakeMessageLine>();
  test::StandingForce wish;
  haptics::DeviceSample sample;
};

TEST_F(HaplyOverALine, IsGreetedOnlyWhenItWaits) {
  (void)open();
  EXPECT_TRUE(line->sent.empty()) << "older ones tell their state unasked";
  EXPECT_EQ(refusalOf(), "the service does not answer within 2000 ms");
  EXPECT_EQ(line->sent, (std::vector<std::string>{haplyGreeting(), "{}"}));
  EXPECT_EQ(line->waits, (std::vector<int>{200, 1000, 1000}));
  line->fault = "it is closed";
  EXPECT_EQ(refusalOf(), "it is closed");
}

TEST_F(HaplyOverALine, IsAskedAgainWhenAnAnswerDoesNotComeForFiftyMilliseconds) {
  HaplyInverse3 device = open();
  wish.force = {1, 2, 3};
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Nothing);
  ASSERT_EQ(line->sent.size(), 1u);
  EXPECT_EQ(line->sent[0], haplyForceCommand("A", {1, -3, 2}));
  EXPECT_EQ(line->waits, std::vector<int>{10});
  wish.ns = 50'000'000;
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Nothing);
  EXPECT_EQ(line->sent.size(), 1u);
  wish.ns += 1;
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Nothing);
  EXPECT_EQ(line->sent.size(), 2u);
  line->waiting = {stateAt(1), stateAt(2)};
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Report);
  EXPECT_EQ(sample.position.x, 2) << "the newest";
  line->waiting = {stateAt(3)};
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Report);
  EXPECT_EQ(line->sent.size(), 3u) << "answered it is told at once";
}

TEST_F(HaplyOverALine, TwentyMessagesInARowThatAreNoneAreALoss) {
  HaplyInverse3 device = open();
  const auto hear = [&](const std::string& message) {
    line->waiting = {message};
    return device.exchange(wish, sample);
  };
  for (int i = 0; i < 19; ++i) EXPECT_EQ(hear("?"), Exchange::Nothing);
  EXPECT_EQ(hear(stateAt(1)), Exchange::Report);
  for (int i = 0; i < 19; ++i) EXPECT_EQ(hear(R"({"session":1})"), Exchange::Nothing);
  EXPECT_EQ(device.lossText(), "");
  EXPECT_EQ(hear("?"), Exchange::Lost);
  EXPECT_EQ(device.lossText(), "the service's messages cannot be understood any more");
  line->waiting = {stateAt(0)};
  ASSERT_TRUE(device.reopen());
  for (int i = 0; i < 19; ++i) EXPECT_EQ(hear("?"), Exchange::Nothing) << "connected again it begins anew";
  EXPECT_EQ(hear(R"({"inverse3":[{"device_id":"B","state":{}}]})"), Exchange::Lost) << "the one that it was opened with";
  EXPECT_EQ(device.lossText(), "the service has no Inverse3 A any more");
}

TEST_F(HaplyOverALine, ItsOwnVelocityIsTakenWhereItIsAskedFor) {
  const std::string moving = stateAt(0, R"(,"cursor_velocity":{"x":0.1,"y":0.2,"z":0.3})");
  for (const bool asked : {false, true}) {
    HaplyInverse3::Options options;
    options.deviceVelocity = asked;
    HaplyInverse3 device = open(options);
    line->waiting = {moving};
    ASSERT_EQ(device.exchange(wish, sample), Exchange::Report);
    EXPECT_EQ(sample.hasVelocity, asked);
    if (asked) {
      EXPECT_EQ(sample.velocity, (Vec3{0.1, 0.3, -0.2}));
    }
    line->waiting = {stateAt(0)};
    device.exchange(wish, sample);
    EXPECT_FALSE(sample.hasVelocity) << "not told";
  }
}

TEST_F(HaplyOverALine, GoneItIsLostInItsOwnWordsAndClosedItIsToldZero) {
  HaplyInverse3 device = open();
  line->fault = "reset by peer";
  line->gone = true;
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Lost);
  EXPECT_EQ(device.lossText(), "reset by peer");
  line->sent.clear();
  device.close();
  EXPECT_EQ(line->sent, std::vector<std::string>{haplyForceCommand("A", {})});
  EXPECT_EQ(device.exchange(wish, sample), Exchange::Lost);
}

TEST(Haply, GivesItsPlaceAndGetsItsForceInItsOwnAxes) {
  for (const auto speaks : {FakeHaply::Speaks::AnswersOnly, FakeHaply::Speaks::GreetsFirst}) {
    FakeHaply service(speaks);
    service.moveTo({0.01, -0.02, 0.03});
    const auto device = openHaply(service, "049D");
    ASSERT_TRUE(until([&] { return norm(device->read().position - Vec3{0.01, 0.03, 0.02}) < 1e-12; }));
    const haptics::DeviceSample sample = device->read();
    EXPECT_EQ(sample.buttons, 0b101u);
    EXPECT_FALSE(sample.hasVelocity);
    ASSERT_TRUE(until([&] {
      device->write({1, 2, 3});
      return service.lastForce() == Vec3{1, -3, 2};
    }));
    EXPECT_TRUE(until([&] { return service.lastForce() == Vec3{}; })) << "a force that is not renewed is taken back";
    EXPECT_TRUE(holds(device->info().version, "gravity_compensation"));
  }
}

TEST(WebSocketLink, WhatCannotBeSentIsALossThoughNobodyListens) {
  FakeHaply service;
  const auto link = openWebSocket("127.0.0.1", service.port());
  EXPECT_TRUE(link->send("{}"));
  service.end();
  EXPECT_TRUE(until([&] { return !link->send("{}"); }));
  EXPECT_NE(link->fault(), "");
}

TEST(Haply, TwoAtOneServiceAreTwoHandsEachWithItsPlaceForceAndGrip) {
  FakeHaply service(FakeHaply::Speaks::AnswersOnly, {"049D", "06A1"});
  service.moveTo({0.01, 0, 0});
  service.moveTo({0.02, 0, 0}, "06A1");
  const auto left = makeDevice(fmt::format("haply:049D,grip=61548,port={0} + haply:06A1,grip=61549,port={0}", service.port()),
                               experiment::readExperiment("chain-two-hands"), 1);
  ASSERT_EQ(left->hands().size(), 2u);
  haptics::HapticDevice& right = *left->hands()[1];
  ASSERT_TRUE(until([&] {
    left->write({1, 0, 0});
    right.write({2, 0, 0});
    return left->read().position.x == 0.01 && right.read().position.x == 0.02 && service.lastForce() == Vec3{1, 0, 0} &&
           service.lastForce("06A1") == Vec3{2, 0, 0};
  }));
  EXPECT_EQ(left->read().buttons, 0b101u);
  EXPECT_EQ(right.read().buttons, 0b010u) << "of its own grip";
  service.setPlugged(false, "06A1");
  ASSERT_TRUE(until([&] { return !right.read().valid; }));
  EXPECT_TRUE(left->read().valid);
  EXPECT_EQ(left->health(), haptics::DeviceHealth::Lost) << "the worst of them";
  EXPECT_TRUE(holds(left->healthText(), "06A1"));
  EXPECT_TRUE(until([&] { return service.lastForce("06A1") == Vec3{}; })) << "it is told zero though it is not in the list";
}

TEST(Haply, OfSeveralGripsOnlyTheOneThatIsNamedIsTaken) {
  FakeHaply service(FakeHaply::Speaks::AnswersOnly, {"049D", "06A1"});
  const auto device = openHaply(service, "049D");
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  EXPECT_EQ(device->read().buttons, 0u) << "a dead-man's button of the other hand would be none";
  EXPECT_TRUE(holds(refusalOfHaply(service, "049D,grip=1"), "there is: 61548, 61549"));
}

TEST(Haply, WhatCannotBeHadIsRefusedInWords) {
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(FakeHaply::Speaks::OldObjects)), "another version"));
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(FakeHaply::Speaks::Garbage)), "no Inverse service"));
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(FakeHaply::Speaks::NoDevice)), "no Inverse3 is connected"));
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(FakeHaply::Speaks::NoWebsocket)), "not as a websocket"));
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(FakeHaply::Speaks::ClosesAtOnce)), "closed"));
  EXPECT_TRUE(holds(refusalOfHaply(FakeHaply(), "FFFF"), "there is: 049D"));
}

TEST(Haply, NobodyThereIsSaidInTheSystemsWords) {
  const auto gone = [] {
    FakeHaply service;
    return service.port();
  }();
  EXPECT_TRUE(
      holds(refusalOf([&] { makeDevice(fmt::format("haply:port={}", gone), experiment::readExperiment("chain-slow"), 1); }), "refused"));
}

}  // namespace
}  // namespace reachlab::devices
