#include "network/peers/peers.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/fault.h"
#include "test_paths.h"

namespace reachlab::network {
namespace {

namespace fs = std::filesystem;

class Peers : public testing::Test {
 protected:
  Peers() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Peers() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  static std::string textOf(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  fs::path folder_ = fs::path(REACHLAB_BINARY_DIR) / "test-files" / ("peers" + std::to_string(::getpid()));
};

TEST_F(Peers, AStationIsAnsweredAndItsKeyStays) {
  initConductor(at("lab"), "left");
  initStation(at("other"), "right");
  EXPECT_FALSE(listPeers(at("other")).at(0).complete);
  const std::string answer = addStation(at("lab"), at("other/request.pem"));
  EXPECT_FALSE(fs::exists(answer + "/key.pem"));
  for (const auto& entry : fs::directory_iterator(answer)) fs::copy(entry.path(), at("other") / entry.path().filename());
  const PeerFolder other = listPeers(at("other")).at(0), left = listPeers(at("lab")).at(0);
  EXPECT_TRUE(other.complete && other.fault.empty()) << other.fault;
  EXPECT_EQ(other.name, "right");
  EXPECT_FALSE(other.conductor);
  EXPECT_TRUE(left.complete && left.conductor && left.fault.empty()) << left.fault;
  EXPECT_EQ(listPeers(at("lab")).size(), 2u);
}

TEST_F(Peers, KeysAreTheOwnersAlone) {
  initConductor(at("lab"), "left");
  for (const char* key : {"lab/key.pem", "lab/authority/identity_ca_key.pem", "lab/authority/permissions_ca_key.pem"}) {
    struct stat status {};
    ASSERT_EQ(::stat(at(key).c_str(), &status), 0) << key;
    EXPECT_EQ(status.st_mode & 0777, 0600u) << key;
  }
  ::chmod(at("lab/key.pem").c_str(), 0644);
  EXPECT_FALSE(listPeers(at("lab")).at(0).fault.empty());
}

// With one authority for both a station could sign permissions for itself.
TEST_F(Peers, ThereAreTwoAuthorities) {
  initConductor(at("lab"), "left");
  EXPECT_NE(textOf(at("lab/identity_ca.pem")), textOf(at("lab/permissions_ca.pem")));
  EXPECT_NE(textOf(at("lab/authority/identity_ca_key.pem")), textOf(at("lab/authority/permissions_ca_key.pem")));
  EXPECT_NE(textOf(at("lab/permissions.p7s")).find("<topic>reach_*</topic>"), std::string::npos);
  EXPECT_NE(textOf(at("lab/permissions.p7s")).find("CN=left"), std::string::npos);
}

TEST_F(Peers, WhatIsWrongWithAFolderIsSaid) {
  initConductor(at("lab"), "left");
  initConductor(at("foreign"), "left");
  fs::copy(at("foreign/identity.pem"), at("lab/identity.pem"), fs::copy_options::overwrite_existing);
  EXPECT_FALSE(listPeers(at("lab")).at(0).fault.empty()) << "a certificate of another authority";
  EXPECT_THROW(initConductor(at("lab"), "left"), FaultError) << "never overwritten";
  EXPECT_THROW(initStation(at("x"), "no name"), FaultError);
  EXPECT_THROW(addStation(at("nowhere"), at("other/request.pem")), FaultError);
  std::ofstream(at("request.pem")) << "nothing";
  EXPECT_THROW(addStation(at("foreign"), at("request.pem")), FaultError);
}

}  // namespace
}  // namespace reachlab::network
