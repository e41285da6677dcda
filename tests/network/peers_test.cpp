#include "network/peers/peers.h"

#include <gtest/gtest.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>

#include "base/fault.h"
#include "network/station/station_options.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace reachlab::network {
namespace {

namespace fs = std::filesystem;

class Peers : public testing::Test {
 protected:
  Peers() { initConductor(at("lab"), "left"); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void copy(const std::string& from, const fs::path& to) const { fs::copy(at(from), to, fs::copy_options::overwrite_existing); }
  static std::string textOf(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }
  const TemporaryFolder folder_;
};

TEST_F(Peers, AStationIsAnsweredAndItsKeyStays) {
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
  for (const char* key : {"lab/key.pem", "lab/authority/identity_ca_key.pem", "lab/authority/permissions_ca_key.pem"}) {
    struct stat status {};
    ASSERT_EQ(::stat(at(key).c_str(), &status), 0) << key;
    EXPECT_EQ(status.st_mode & 0777, 0600u) << key;
  }
  struct stat folder {};
  ASSERT_EQ(::stat(at("lab").c_str(), &folder), 0);
  EXPECT_EQ(folder.st_mode & 0777, 0700u) << "and so is their folder";
  ::chmod(at("lab/key.pem").c_str(), 0644);
  EXPECT_FALSE(listPeers(at("lab")).at(0).fault.empty());
}

TEST_F(Peers, WhatIsWrongWithAFolderIsSaid) {
  initConductor(at("foreign"), "left");
  copy("foreign/identity.pem", at("lab/identity.pem"));
  EXPECT_FALSE(listPeers(at("lab")).at(0).fault.empty()) << "a certificate of another authority";
  copy("foreign/identity_ca.pem", at("lab/identity_ca.pem"));
  copy("foreign/key.pem", at("lab/key.pem"));
  EXPECT_EQ(listPeers(at("lab")).at(0).fault, "");
  copy("foreign/governance.p7s", at("lab/governance.p7s"));
  EXPECT_EQ(listPeers(at("lab")).at(0).fault, "governance.p7s is not signed by this authority");
  initStation(at("other"), "right");
  const std::string answer = addStation(at("foreign"), at("other/request.pem"));
  copy("foreign/permissions.p7s", answer + "/permissions.p7s");
  EXPECT_EQ(listPeers(at("foreign")).at(1).fault, "the permissions are another station's");
  EXPECT_THROW(initConductor(at("lab"), "left"), FaultError) << "never overwritten";
  EXPECT_THROW(initStation(at("x"), "no name"), FaultError);
  EXPECT_THROW(addStation(at("nowhere"), at("other/request.pem")), FaultError);
  std::ofstream(at("request.pem")) << "nothing";
  EXPECT_THROW(addStation(at("foreign"), at("request.pem")), FaultError);
}

// Before a run: the network itself only says that it cannot begin.
TEST_F(Peers, AStationDoesNotBeginWithAFolderThatHasAFault) {
  initConductor(at("foreign"), "left");
  initStation(at("other"), "right");
  StationSetup setup;
  const auto refusal = [&](const char* folder) {
    setup.link.secure = at(folder);
    return refusalOf([&] { completeStationSetup(setup, "mouse", "reach"); });
  };
  EXPECT_TRUE(holds(refusal("other"), "waits for the conductor's answer"));
  copy("foreign/identity.pem", at("lab/identity.pem"));
  EXPECT_TRUE(holds(refusal("lab"), "the certificate is not of this authority"));
  fs::remove(at("foreign/governance.p7s"));
  EXPECT_TRUE(holds(refusal("foreign"), "are missing"));
}

template <class Thing, auto Free>
using Owned = std::unique_ptr<Thing, decltype([](Thing* thing) { Free(thing); })>;
using Certificate = Owned<X509, X509_free>;
using Bio = Owned<BIO, BIO_free_all>;

Certificate certificateAt(const std::string& path) {
  const Bio in(BIO_new_file(path.c_str(), "r"));
  return Certificate(PEM_read_bio_X509(in.get(), nullptr, nullptr, nullptr));
}

bool isCritical(const X509* certificate, int kind) {
  const int at = X509_get_ext_by_NID(certificate, kind, -1);
  return at >= 0 && X509_EXTENSION_get_critical(X509_get_ext(certificate, at)) == 1;
}

// RFC 5280, 4.2.1.3 and 4.2.1.9: who may sign for others says so, and who may not says that, and no reader may pass over it.
TEST_F(Peers, AnAuthoritySignsForOthersAndAStationDoesNot) {
  for (const char* authority : {"lab/identity_ca.pem", "lab/permissions_ca.pem"}) {
    const Certificate certificate = certificateAt(at(authority));
    EXPECT_EQ(X509_check_ca(certificate.get()), 1) << authority;
    EXPECT_TRUE(isCritical(certificate.get(), NID_basic_constraints)) << authority;
    EXPECT_TRUE(isCritical(certificate.get(), NID_key_usage)) << authority;
    EXPECT_EQ(X509_get_key_usage(certificate.get()), unsigned{KU_KEY_CERT_SIGN | KU_CRL_SIGN | KU_DIGITAL_SIGNATURE}) << authority;
    EXPECT_EQ(X509_verify(certificate.get(), X509_get0_pubkey(certificate.get())), 1) << authority << " signs itself";
  }
  const Certificate station = certificateAt(at("lab/identity.pem"));
  EXPECT_EQ(X509_check_ca(station.get()), 0);
  EXPECT_TRUE(isCritical(station.get(), NID_basic_constraints));
  EXPECT_EQ(X509_get_version(station.get()), X509_VERSION_3);
  EXPECT_EQ(X509_verify(station.get(), X509_get0_pubkey(certificateAt(at("lab/identity_ca.pem")).get())), 1);
  EXPECT_EQ(X509_NAME_cmp(X509_get_issuer_name(station.get()), X509_get_subject_name(certificateAt(at("lab/identity_ca.pem")).get())), 0);
  EXPECT_NE(ASN1_INTEGER_cmp(X509_get0_serialNumber(station.get()), X509_get0_serialNumber(certificateAt(at("lab/identity_ca.pem")).get())),
            0);
}

// Clocks of two machines may be a day apart.
TEST_F(Peers, CertificatesAndPermissionsHoldFromTheDayBeforeForAsManyDaysAsAreAsked) {
  std::time_t before = std::time(nullptr);
  initConductor(at("short"), "left", {.days = 10});
  std::time_t after = std::time(nullptr);
  constexpr std::time_t kDay = 24 * 60 * 60;
  const Certificate certificate = certificateAt(at("short/identity.pem"));
  const auto isAt = [&](const ASN1_TIME* time, std::time_t days) {
    std::time_t earliest = before + days * kDay - 1, latest = after + days * kDay + 1;
    return X509_cmp_time(time, &earliest) > 0 && X509_cmp_time(time, &latest) < 0;
  };
  EXPECT_TRUE(isAt(X509_get0_notBefore(certificate.get()), -1));
  EXPECT_TRUE(isAt(X509_get0_notAfter(certificate.get()), 10));
  std::smatch found;
  const std::string permissions = textOf(at("short/permissions.p7s"));
  ASSERT_TRUE(std::regex_search(permissions, found, std::regex("<not_before>(.*)</not_before><not_after>(.*)</not_after>")));
  initStation(at("other"), "right");
  addStation(at("short"), at("other/request.pem"), {.days = 100});
  const std::vector<PeerFolder> peers = listPeers(at("short"));
  EXPECT_EQ(peers.at(1).validUntil, peers.at(0).validUntil) << "no longer than the authority that signed";
  for (const auto& [text, days] : {std::pair{found[1].str(), -1}, std::pair{found[2].str(), 10}}) {
    std::tm parts{};
    ASSERT_NE(strptime(text.c_str(), "%Y-%m-%dT%H:%M:%S", &parts), nullptr) << text;
    EXPECT_GE(timegm(&parts), before + days * kDay) << text;
    EXPECT_LE(timegm(&parts), after + days * kDay) << text;
  }
}

TEST_F(Peers, WhatIsPermittedIsSignedByItsOwnAuthorityAlone) {
  const auto isSignedBy = [&](const std::string& document, const std::string& authority) {
    const Bio in(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())));
    BIO* raw = nullptr;
    const Owned<PKCS7, PKCS7_free> made(SMIME_read_PKCS7(in.get(), &raw));
    const Bio text(raw);
    const Owned<X509_STORE, X509_STORE_free> store(X509_STORE_new());
    X509_STORE_add_cert(store.get(), certificateAt(at(authority)).get());
    return PKCS7_verify(made.get(), nullptr, store.get(), text.get(), nullptr, PKCS7_TEXT) == 1;
  };
  for (const char* name : {"lab/permissions.p7s", "lab/governance.p7s"}) {
    std::string document = textOf(at(name));
    EXPECT_TRUE(isSignedBy(document, "lab/permissions_ca.pem")) << name;
    EXPECT_FALSE(isSignedBy(document, "lab/identity_ca.pem")) << name;
    const std::size_t place = document.find("<max>230");
    ASSERT_NE(place, std::string::npos) << name;
    document[place + 5] = '1';
    EXPECT_FALSE(isSignedBy(document, "lab/permissions_ca.pem")) << name << ", changed by somebody";
  }
}

TEST_F(Peers, ANameIsOneToSixtyLettersDigitsAndHyphens) {
  initStation(at("longest"), std::string(60, 'a'));
  EXPECT_EQ(listPeers(at("longest")).at(0).name, std::string(60, 'a'));
  initStation(at("mixed"), "Left-2");
  for (const std::string& name :
       {std::string(), std::string(61, 'a'), std::string("a_b"), std::string("a/b"), std::string("l\xc3\xa4nge")}) {
    EXPECT_THROW(initStation(at("none"), name), FaultError) << name;
    EXPECT_THROW(initConductor(at("none"), name), FaultError) << name;
  }
  EXPECT_FALSE(fs::exists(at("none"))) << "nothing is made for a name that is none";
}

TEST_F(Peers, AFolderIsToldAsItStands) {
  initStation(at("right"), "right");
  const PeerFolder waiting = listPeers(at("right")).at(0);
  EXPECT_EQ(waiting.name, "right");
  EXPECT_FALSE(waiting.complete || waiting.conductor);
  EXPECT_EQ(waiting.fault, "waits for the conductor's answer to request.pem");
  fs::create_directories(at("empty"));
  EXPECT_EQ(listPeers(at("empty")).at(0).fault, "holds no certificate");
  EXPECT_THROW(listPeers(at("nowhere")), FaultError);

  initConductor(at("late"), "left", {.days = -1});
  EXPECT_EQ(listPeers(at("late")).at(0).fault, "the certificate has expired");
  EXPECT_NE(listPeers(at("late")).at(0).validUntil, "");
  EXPECT_EQ(listPeers(at("lab")).at(0).fault, "");
  copy("right/key.pem", at("lab/key.pem"));
  EXPECT_EQ(listPeers(at("lab")).at(0).fault, "the certificate is not of this key");
}

TEST_F(Peers, NothingIsCompleteWithoutAnyOneOfItsFiles) {
  for (const char* file : {"identity.pem", "identity_ca.pem", "permissions_ca.pem", "governance.p7s", "permissions.p7s", "key.pem"}) {
    fs::rename(at("lab") + "/" + file, at("aside"));
    EXPECT_FALSE(listPeers(at("lab")).at(0).complete) << file;
    fs::rename(at("aside"), at("lab") + "/" + file);
  }
  EXPECT_TRUE(listPeers(at("lab")).at(0).complete);
}

TEST_F(Peers, WhoWasAnsweredStandsInTheOrderOfTheNamesAndNeedsNoKeyThere) {
  for (const char* name : {"zeta", "alpha"}) {
    initStation(at(name), name);
    EXPECT_EQ(addStation(at("lab"), at(name) + "/request.pem"), at("lab") + "/for-" + name);
    EXPECT_THROW(addStation(at("lab"), at(name) + "/request.pem"), FaultError) << "never overwritten";
  }
  fs::create_directories(at("lab/notes"));
  const std::vector<PeerFolder> all = listPeers(at("lab"));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].name, "alpha");
  EXPECT_EQ(all[2].name, "zeta");
  for (const PeerFolder& one : {all[1], all[2]}) EXPECT_TRUE(one.complete && !one.conductor && one.fault.empty()) << one.fault;
}

// Two stations of one name could not be told apart, and one of them conducts.
TEST_F(Peers, AStationWithTheConductorsNameIsRefused) {
  initStation(at("right"), "left");
  EXPECT_EQ(faultsToldBy([&] { addStation(at("lab"), at("right/request.pem")); }).at(0).what,
            "is of a station named \"left\", which is the conductor's name");
  EXPECT_FALSE(fs::exists(at("lab/for-left")));
}

// Whoever changes the name in a request cannot sign it again.
TEST_F(Peers, ARequestThatItsOwnKeyDidNotSignIsRefused) {
  initStation(at("right"), "right");
  Bio in(BIO_new_file((at("right") + "/request.pem").c_str(), "r"));
  const Owned<X509_REQ, X509_REQ_free> request(PEM_read_bio_X509_REQ(in.get(), nullptr, nullptr, nullptr));
  const Owned<X509_NAME, X509_NAME_free> name(X509_NAME_new());
  X509_NAME_add_entry_by_txt(name.get(), "CN", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>("left"), -1, -1, 0);
  X509_REQ_set_subject_name(request.get(), name.get());
  {
    const Bio out(BIO_new_file(at("changed.pem").c_str(), "w"));
    PEM_write_bio_X509_REQ(out.get(), request.get());
  }
  const Fault fault = faultsToldBy([&] { addStation(at("lab"), at("changed.pem")); }).at(0);
  EXPECT_EQ(fault.what, "is not signed by its own key");
  EXPECT_EQ(fault.place->file, at("changed.pem"));
}

}  // namespace
}  // namespace reachlab::network
