#include "devices/haply/haply_device.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "base/error.h"
#include "devices/haply/web_socket_link.h"
#include "devices/live_device.h"
#include "devices/make_device.h"
#include "devices/registry.h"
#include "tests/devices/fakes/fake_haply.h"
#include "tests/until.h"

namespace reachlab::devices {
namespace {

using test::FakeHaply;
using test::until;

std::unique_ptr<haptics::HapticDevice> open(const FakeHaply& service, const std::string& id = "") {
  return makeDevice(fmt::format("haply:{}{}port={}", id, id.empty() ? "" : ",", service.port()), experiment::readExperiment("chain-slow"),
                    1);
}

std::string refusal(const FakeHaply& service, const std::string& id = "") {
  try {
    open(service, id);
  } catch (const ResourceError& error) {
    return error.what();
  }
  return "it was opened";
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
  EXPECT_EQ(readHaplyMessage("", "", state), HaplyAnswer::NotJson);
  EXPECT_EQ(readHaplyMessage("[1, 2]", "", state), HaplyAnswer::NotJson);
  EXPECT_EQ(readHaplyMessage("{\"inverse3\": {\"049D\": {}}}", "", state), HaplyAnswer::OtherVersion);
  EXPECT_EQ(readHaplyMessage("{\"inverse3\": []}", "", state), HaplyAnswer::NoDevice);
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{}}]})", "", state), HaplyAnswer::OtherVersion);
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"place":{"x":1}}}]})", "", state), HaplyAnswer::OtherVersion);
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"control_mode":"idle"}}]})", "", state), HaplyAnswer::State)
      << "what equals its identity is left out";
  EXPECT_EQ(state.position, Vec3{});
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":"left"}}}]})", "", state),
            HaplyAnswer::NotJson);
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"x":1e999}}}]})", "", state),
            HaplyAnswer::NotJson);
  EXPECT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"z":0.1}}}]})", "B", state),
            HaplyAnswer::NoDevice);
  ASSERT_EQ(readHaplyMessage(R"({"inverse3":[{"device_id":"A","state":{"cursor_position":{"z":0.1}}}]})", "", state), HaplyAnswer::State);
  EXPECT_EQ(state.position, (Vec3{0, 0, 0.1})) << "what is left out is zero";
}

TEST(Haply, GivesItsPlaceAndGetsItsForceInItsOwnAxes) {
  for (const auto speaks : {FakeHaply::Speaks::AnswersOnly, FakeHaply::Speaks::GreetsFirst}) {
    FakeHaply service(speaks);
    service.moveTo({0.01, -0.02, 0.03});
    const auto device = open(service, "049D");
    ASSERT_TRUE(until([&] { return norm(device->read().position - Vec3{0.01, 0.03, 0.02}) < 1e-12; }));
    const haptics::DeviceSample sample = device->read();
    EXPECT_EQ(sample.buttons, 0b101u);
    EXPECT_FALSE(sample.hasVelocity);
    ASSERT_TRUE(sample.hasOrientation);
    EXPECT_NEAR(sample.orientation[2], 0.8, 1e-12) << "z of the grip is y of the world";
    EXPECT_NEAR(sample.orientation[3], -0.6, 1e-12);
    ASSERT_TRUE(until([&] {
      device->write({1, 2, 3});
      return service.lastForce() == Vec3{1, -3, 2};
    }));
    EXPECT_TRUE(until([&] { return service.lastForce() == Vec3{}; })) << "a force that is not renewed is taken back";
    EXPECT_NE(device->info().version.find("gravity_compensation"), std::string::npos) << device->info().version;
  }
}

TEST(Haply, ItsLastWordIsZero) {
  FakeHaply service;
  {
    const auto device = open(service);
    ASSERT_TRUE(until([&] {
      device->write({0, 0, 1});
      return norm(service.lastForce()) > 0;
    }));
  }
  EXPECT_TRUE(until([&] { return service.lastForce() == Vec3{}; }));
}

TEST(Haply, AServiceThatEndsIsALossWithASentence) {
  FakeHaply service;
  const auto device = open(service);
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  service.end();
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  EXPECT_EQ(device->health(), haptics::DeviceHealth::Lost);
  EXPECT_FALSE(device->healthText().empty());
}

TEST(WebSocketLink, WhatCannotBeSentIsALossThoughNobodyListens) {
  FakeHaply service;
  const auto link = openWebSocket("127.0.0.1", service.port());
  EXPECT_TRUE(link->send("{}"));
  service.end();
  EXPECT_TRUE(until([&] { return !link->send("{}"); }));
  EXPECT_NE(link->fault(), "");
}

TEST(Haply, AnUnpluggedDeviceIsLostThoughItsServiceAnswersAndComesBack) {
  FakeHaply service;
  const auto device = open(service);
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  service.setPlugged(false);
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  EXPECT_NE(device->healthText().find("049D"), std::string::npos) << device->healthText();
  service.setPlugged(true);
  EXPECT_TRUE(until([&] { return device->read().valid; }));
}

TEST(LiveDevice, SaysThatItsDeviceIsLostAndOtherwiseNothing) {
  FakeHaply service;
  LiveDevice live(fmt::format("haply:port={}", service.port()), experiment::CompiledExperiment(experiment::readExperiment("chain-slow")));
  ASSERT_TRUE(until([&] { return live.look().valid; }));
  EXPECT_EQ(live.look().fault, "");
  service.setPlugged(false);
  EXPECT_TRUE(until([&] { return live.look().fault.find("is lost") != std::string::npos; })) << live.look().fault;
}

TEST(Haply, ASentenceOfGarbageIsPassedOverAndMuchOfItIsALoss) {
  FakeHaply service;
  const auto device = open(service);
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  service.garbles = true;
  ASSERT_TRUE(until([&] { return !device->read().valid; }));
  EXPECT_NE(device->healthText().find("cannot be understood"), std::string::npos) << device->healthText();
}

TEST(Haply, AServiceThatFallsSilentGivesNoNewReportAndHoldsNothingUp) {
  FakeHaply service;
  const auto device = open(service);
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  service.silent = true;
  std::uint64_t reports = 0;
  until([&] { return std::exchange(reports, device->read().reports) == device->read().reports; });
  const std::uint64_t forces = service.forces();
  ASSERT_TRUE(until([&] { return service.forces() > forces + 2; })) << "it goes on being told";
  EXPECT_LE(device->read().reports, reports + 1);
  service.silent = false;
  EXPECT_TRUE(until([&] { return device->read().reports > reports + 5; }));
}

TEST(Haply, TwoAtOneServiceAreTwoHandsEachWithItsPlaceForceAndGrip) {
  FakeHaply service(FakeHaply::Speaks::AnswersOnly, {"049D", "06A1"});
  service.moveTo({0.01, 0, 0});
  service.moveTo({0.02, 0, 0}, "06A1");
  const auto left = makeDevice(fmt::format("haply:049D,grip=61548,port={0} + haply:06A1,grip=61549,port={0}", service.port()),
                               experiment::readExperiment("chain-two-hands"), 1);
  ASSERT_EQ(left->otherHands().size(), 1u);
  haptics::HapticDevice& right = *left->otherHands()[0];
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
  EXPECT_NE(left->healthText().find("06A1"), std::string::npos) << left->healthText();
  EXPECT_TRUE(until([&] { return service.lastForce("06A1") == Vec3{}; })) << "it is told zero though it is not in the list";
}

TEST(Haply, OfSeveralGripsOnlyTheOneThatIsNamedIsTaken) {
  FakeHaply service(FakeHaply::Speaks::AnswersOnly, {"049D", "06A1"});
  const auto device = open(service, "049D");
  ASSERT_TRUE(until([&] { return device->read().reports > 5; }));
  EXPECT_EQ(device->read().buttons, 0u) << "a dead-man's button of the other hand would be none";
  EXPECT_FALSE(device->read().hasOrientation);
  EXPECT_NE(refusal(service, "049D,grip=1").find("there is: 61548, 61549"), std::string::npos) << refusal(service, "049D,grip=1");
}

TEST(Haply, WhatCannotBeHadIsRefusedInWords) {
  EXPECT_NE(refusal(FakeHaply(FakeHaply::Speaks::OldObjects)).find("another version"), std::string::npos);
  EXPECT_NE(refusal(FakeHaply(FakeHaply::Speaks::Garbage)).find("no Inverse service"), std::string::npos);
  EXPECT_NE(refusal(FakeHaply(FakeHaply::Speaks::NoDevice)).find("no Inverse3 is connected"), std::string::npos);
  EXPECT_NE(refusal(FakeHaply(FakeHaply::Speaks::NoWebsocket)).find("not as a websocket"), std::string::npos);
  EXPECT_NE(refusal(FakeHaply(FakeHaply::Speaks::ClosesAtOnce)).find("closed"), std::string::npos);
  EXPECT_NE(refusal(FakeHaply(), "FFFF").find("there is: 049D"), std::string::npos);
}

TEST(Haply, NobodyThereIsSaidInTheSystemsWords) {
  const auto gone = [] {
    FakeHaply service;
    return service.port();
  }();
  try {
    makeDevice(fmt::format("haply:port={}", gone), experiment::readExperiment("chain-slow"), 1);
    FAIL() << "it was opened";
  } catch (const ResourceError& error) {
    EXPECT_NE(std::string(error.what()).find("refused"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace reachlab::devices
