#include "network/peers/peers.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/fault.h"
#include "base/text_file.h"

namespace reachlab::network {
namespace fs = std::filesystem;
namespace {

template <auto Free>
struct Freed {
  void operator()(auto* thing) const { Free(thing); }
};
void freeStack(STACK_OF(X509) * stack) { sk_X509_free(stack); }
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Request = std::unique_ptr<X509_REQ, Freed<X509_REQ_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Signed = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;

constexpr long kDay = 86400;  // [s]

[[noreturn]] void fail(const std::string& what) {
  const unsigned long code = ERR_get_error();
  const char* reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  throw ResourceError(what + (reason == nullptr ? "" : std::string(": ") + reason));
}
template <class T>
T need(T thing, const std::string& what) {
  if (!thing) fail(what);
  return thing;
}

void requireName(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  const bool good = !name.empty() && name.size() <= kLongest &&
                    std::all_of(name.begin(), name.end(), [](unsigned char c) { return c < 128 && (std::isalnum(c) != 0 || c == '-'); });
  if (!good) throw FaultError(Fault{"name", fmt::format("is \"{}\"", name), fmt::format("up to {} letters, digits and hyphens", kLongest)});
}

// Secrets are the owner's alone from the first byte on.
Bio openForWriting(const std::string& path, bool secret) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, secret ? 0600 : 0644);
  if (descriptor < 0) throw ResourceError(fmt::format("{}: cannot be made: {}", path, std::strerror(errno)));
  return Bio(need(BIO_new_fd(descriptor, BIO_CLOSE), path));
}
Bio openForReading(const std::string& path) {
  Bio bio(BIO_new_file(path.c_str(), "r"));
  if (!bio) throw ResourceError(fmt::format("{}: cannot be read", path));
  return bio;
}

Key makeKey() { return Key(need(EVP_EC_gen("P-256"), "a key cannot be made")); }
/// `write` is called with the open file and returns 1 if it was written.
template <class Write>
void writeNew(const std::string& path, bool secret, Write&& write) {
  const Bio out = openForWriting(path, secret);
  if (write(out.get()) != 1) fail(path);
}
void writeKey(const Key& key, const std::string& path) {
  writeNew(path, true, [&](BIO* out) { return PEM_write_bio_PrivateKey(out, key.get(), nullptr, nullptr, 0, nullptr, nullptr); });
}
/// Null when the file holds none.
template <class Thing, auto Read>
Thing readPem(const std::string& path) {
  return Thing(Read(openForReading(path).get(), nullptr, nullptr, nullptr));
}
Key readKey(const std::string& path) { return need(readPem<Key, PEM_read_bio_PrivateKey>(path), path + ": is no key"); }
void writeCertificate(const Certificate& certificate, const std::string& path) {
  writeNew(path, false, [&](BIO* out) { return PEM_write_bio_X509(out, certificate.get()); });
}
Certificate readCertificate(const std::string& path) {
  return need(readPem<Certificate, PEM_read_bio_X509>(path), path + ": is no certificate");
}
Request readRequest(const std::string& path) { return readPem<Request, PEM_read_bio_X509_REQ>(path); }

std::string commonName(const X509_NAME* subject) {
  char text[256] = {};
  X509_NAME_get_text_by_NID(const_cast<X509_NAME*>(subject), NID_commonName, text, sizeof text - 1);
  return text;
}

/// Of a name that has no entries yet.
void setCommonName(X509_NAME* subject, const std::string& name) {
  constexpr int kToItsEnd = -1, kAsTheLast = -1;
  X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, reinterpret_cast<const unsigned char*>(name.c_str()), kToItsEnd, kAsTheLast, 0);
}

/// `issuer` and its key sign; without an issuer the certificate signs itself, as an authority.
Certificate makeCertificate(const std::string& name, const Key& key, const X509* issuer, const Key& issuerKey, int days) {
  Certificate made(need(X509_new(), "a certificate cannot be made"));
  X509* certificate = made.get();
  X509_set_version(certificate, X509_VERSION_3);
  std::uint64_t serial = 0;
  RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial);
  ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), serial >> 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate), -kDay);
  X509_gmtime_adj(X509_getm_notAfter(certificate), kDay * days);
  // Nobody accepts a certificate beyond its authority's last day.
  if (issuer != nullptr && ASN1_TIME_compare(X509_get0_notAfter(certificate), X509_get0_notAfter(issuer)) > 0)
    X509_set1_notAfter(certificate, X509_get0_notAfter(issuer));
  X509_set_pubkey(certificate, key.get());
  X509_NAME* subject = X509_get_subject_name(certificate);
  setCommonName(subject, name);
  X509_set_issuer_name(certificate, issuer == nullptr ? subject : X509_get_subject_name(issuer));
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer == nullptr ? certificate : const_cast<X509*>(issuer), certificate, nullptr, nullptr, 0);
  const auto extend = [&](int kind, const char* value) {
    std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
    if (!extension || X509_add_ext(certificate, extension.get(), -1) != 1) fail("a certificate cannot be made");
  };
  extend(NID_basic_constraints, issuer == nullptr ? "critical,CA:TRUE" : "critical,CA:FALSE");
  if (issuer == nullptr) extend(NID_key_usage, "critical,keyCertSign,cRLSign,digitalSignature");
  if (X509_sign(certificate, (issuer == nullptr ? key : issuerKey).get(), EVP_sha256()) == 0) fail("a certificate cannot be signed");
  return made;
}

/// A document as DDS Security reads it: S/MIME, the text in clear beside its signature.
void writeSigned(const std::string& document, const Certificate& signer, const Key& key, const std::string& path) {
  const Bio text(need(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())), path));
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const Signed made(need(PKCS7_sign(signer.get(), key.get(), nullptr, text.get(), kFlags), path + ": cannot be signed"));
  writeNew(path, false, [&](BIO* out) { return SMIME_write_PKCS7(out, made.get(), text.get(), kFlags); });
}

/// The text of a signed document, or nothing if `signer` did not sign it.
std::optional<std::string> textSignedBy(const Certificate& signer, const std::string& path) {
  const Bio in = openForReading(path);
  BIO* clear = nullptr;
  const Signed document(SMIME_read_PKCS7(in.get(), &clear));
  const Bio content(clear), text(BIO_new(BIO_s_mem()));
  const std::unique_ptr<STACK_OF(X509), Freed<freeStack>> signers(sk_X509_new_null());
  sk_X509_push(signers.get(), signer.get());
  constexpr int kFlags = PKCS7_NOVERIFY | PKCS7_NOINTERN | PKCS7_TEXT;  // by this certificate and no other
  if (!document || PKCS7_verify(document.get(), signers.get(), nullptr, content.get(), text.get(), kFlags) != 1) return std::nullopt;
  char* data = nullptr;
  const long size = BIO_get_mem_data(text.get(), &data);
  return std::string(data, static_cast<std::size_t>(size));
}

// Everything encrypted, nobody without a certificate and permissions.
constexpr const char* kGovernance = R"(<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_governance.xsd">
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
)";

std::string grantTo(const std::string& name) { return fmt::format("<subject_name>CN={}</subject_name>", name); }
std::string permissionsOf(const std::string& name, int days) {
  const std::time_t now = std::time(nullptr);
  const auto at = [](std::time_t time) { return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(time)); };
  return fmt::format(R"(<?xml version="1.0" encoding="utf-8"?>
<dds xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="http://www.omg.org/spec/DDS-SECURITY/20170901/omg_shared_ca_permissions.xsd">
  <permissions>
    <grant name="{0}">
      {3}
      <validity><not_before>{1}</not_before><not_after>{2}</not_after></validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
        <publish><topics><topic>reach_*</topic></topics></publish>
        <subscribe><topics><topic>reach_*</topic></topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
)",
                     name, at(now - kDay), at(now + kDay * days), grantTo(name));
}

void makeFolder(const std::string& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_empty(folder, error))
    throw FaultError(
        Fault{"peers", fmt::format("{} is there already", folder), "a new or empty folder: certificates are never overwritten"});
  fs::create_directories(folder, error);
  if (error) throw ResourceError(fmt::format("{}: cannot be made: {}", folder, error.message()));
  fs::permissions(folder, fs::perms::owner_all, error);
}

struct Authorities {
  Key identityKey, permissionsKey;
  Certificate identity, permissions;
};
std::string authorityFolder(const std::string& folder) { return folder + "/authority"; }
Authorities readAuthorities(const std::string& folder) {
  const std::string at = authorityFolder(folder);
  if (!isThere(at))
    throw FaultError(Fault{"peers", fmt::format("{} has no authorities", folder), "the conductor's folder, where they were made"});
  return {readKey(at + "/identity_ca_key.pem"), readKey(at + "/permissions_ca_key.pem"), readCertificate(at + "/identity_ca.pem"),
          readCertificate(at + "/permissions_ca.pem")};
}

// What a station needs beside its own key.
void answer(const std::string& folder, const std::string& name, const Key& key, const Authorities& by, int days) {
  writeCertificate(by.identity, folder + "/identity_ca.pem");
  writeCertificate(by.permissions, folder + "/permissions_ca.pem");
  writeCertificate(makeCertificate(name, key, by.identity.get(), by.identityKey, days), folder + "/identity.pem");
  writeSigned(kGovernance, by.permissions, by.permissionsKey, folder + "/governance.p7s");
  writeSigned(permissionsOf(name, days), by.permissions, by.permissionsKey, folder + "/permissions.p7s");
}

// Who may do what: both documents are signed, and the permissions are this station's. Empty: no fault.
std::string documentsFault(const std::string& folder, const std::string& name) {
  const Certificate authority = readCertificate(folder + "/permissions_ca.pem");
  if (!textSignedBy(authority, folder + "/governance.p7s")) return "governance.p7s is not signed by this authority";
  const std::optional<std::string> permissions = textSignedBy(authority, folder + "/permissions.p7s");
  if (!permissions) return "permissions.p7s is not signed by this authority";
  return permissions->find(grantTo(name)) == std::string::npos ? "the permissions are another station's" : "";
}

PeerFolder lookAt(const std::string& folder, bool needsKey) {
  PeerFolder found;
  found.conductor = isThere(authorityFolder(folder));
  const auto has = [&](const char* file) { return isThere(folder + "/" + file); };
  try {
    if (has("identity.pem")) {
      const Certificate certificate = readCertificate(folder + "/identity.pem");
      found.name = commonName(X509_get_subject_name(certificate.get()));
      const Bio text(BIO_new(BIO_s_mem()));
      ASN1_TIME_print(text.get(), X509_get0_notAfter(certificate.get()));
      char buffer[64] = {};
      BIO_read(text.get(), buffer, sizeof buffer - 1);
      found.validUntil = buffer;
      if (X509_cmp_current_time(X509_get0_notAfter(certificate.get())) < 0) found.fault = "the certificate has expired";
      if (needsKey && has("key.pem") && X509_check_private_key(certificate.get(), readKey(folder + "/key.pem").get()) != 1)
        found.fault = "the certificate is not of this key";
      if (has("identity_ca.pem")) {
        const Certificate authority = readCertificate(folder + "/identity_ca.pem");
        if (X509_verify(certificate.get(), X509_get0_pubkey(authority.get())) != 1)
          found.fault = "the certificate is not of this authority";
      }
      if (has("permissions_ca.pem") && has("governance.p7s") && has("permissions.p7s"))
        if (const std::string fault = documentsFault(folder, found.name); !fault.empty()) found.fault = fault;
    } else if (has("request.pem")) {
      if (const Request request = readRequest(folder + "/request.pem")) found.name = commonName(X509_REQ_get_subject_name(request.get()));
      found.fault = "waits for the conductor's answer to request.pem";
    } else {
      found.fault = "holds no certificate";
    }
  } catch (const Error& error) {
    found.fault = error.what();
  }
  constexpr std::array kAnswer{"identity.pem", "identity_ca.pem", "permissions_ca.pem", "governance.p7s", "permissions.p7s"};
  found.complete = std::all_of(kAnswer.begin(), kAnswer.end(), has) && (!needsKey || has("key.pem"));
  struct stat status {};
  if (needsKey && ::stat((folder + "/key.pem").c_str(), &status) == 0 && (status.st_mode & 077) != 0)
    found.fault = "others may read its key.pem";
  return found;
}

}  // namespace

void initConductor(const std::string& folder, const std::string& name, const PeersOptions& options) {
  requireName(name);
  makeFolder(folder);
  const std::string at = authorityFolder(folder);
  makeFolder(at);
  Authorities made{makeKey(), makeKey(), nullptr, nullptr};
  made.identity = makeCertificate("reachlab identities", made.identityKey, nullptr, made.identityKey, options.days);
  made.permissions = makeCertificate("reachlab permissions", made.permissionsKey, nullptr, made.permissionsKey, options.days);
  writeKey(made.identityKey, at + "/identity_ca_key.pem");
  writeKey(made.permissionsKey, at + "/permissions_ca_key.pem");
  writeCertificate(made.identity, at + "/identity_ca.pem");
  writeCertificate(made.permissions, at + "/permissions_ca.pem");
  const Key key = makeKey();
  writeKey(key, folder + "/key.pem");
  answer(folder, name, key, made, options.days);
}

void initStation(const std::string& folder, const std::string& name) {
  requireName(name);
  makeFolder(folder);
  const Key key = makeKey();
  const Request request(need(X509_REQ_new(), "a request cannot be made"));
  setCommonName(X509_REQ_get_subject_name(request.get()), name);
  X509_REQ_set_pubkey(request.get(), key.get());
  if (X509_REQ_sign(request.get(), key.get(), EVP_sha256()) == 0) fail("a request cannot be signed");
  writeKey(key, folder + "/key.pem");
  writeNew(folder + "/request.pem", false, [&](BIO* out) { return PEM_write_bio_X509_REQ(out, request.get()); });
}

std::string addStation(const std::string& folder, const std::string& requestFile, const PeersOptions& options) {
  const Authorities by = readAuthorities(folder);
  const Request request = readRequest(requestFile);
  if (!request) throw FaultError(Fault{"request", "is none", "a station's request.pem", FilePlace{requestFile}});
  const Key key(X509_REQ_get_pubkey(request.get()));
  if (!key || X509_REQ_verify(request.get(), key.get()) != 1)
    throw FaultError(Fault{"request", "is not signed by its own key", "a station's request.pem as it was made", FilePlace{requestFile}});
  const std::string name = commonName(X509_REQ_get_subject_name(request.get()));
  requireName(name);
  if (const std::string own = lookAt(folder, true).name; own == name)
    throw FaultError(Fault{"request", fmt::format("is of a station named \"{}\", which is the conductor's name", name),
                           "another name: make the station's key again with it", FilePlace{requestFile}});
  const std::string out = folder + "/for-" + name;
  makeFolder(out);
  answer(out, name, key, by, options.days);
  return out;
}

std::vector<PeerFolder> listPeers(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw FaultError(Fault{"peers", fmt::format("{} is no folder", folder), "a folder of certificates"});
  std::vector<PeerFolder> all{lookAt(folder, true)};
  std::vector<std::string> answered;
  auto entry = fs::directory_iterator(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (entry->is_directory(error) && entry->path().filename().string().starts_with("for-")) answered.push_back(entry->path().string());
  if (error) throw ResourceError(fmt::format("{}: cannot be read: {}", folder, error.message()));
  std::sort(answered.begin(), answered.end());
  for (const std::string& one : answered) all.push_back(lookAt(one, false));
  return all;
}

}  // namespace reachlab::network
