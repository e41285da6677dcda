#pragma once
#include <string>
#include <vector>

/// Who belongs to a laboratory, as DDS Security wants it: each station has a key and a certificate of its own, and signed permissions. There
/// are two authorities, because with one for both a station could sign permissions for itself. Keys are made where they stay: a station's on
/// the station (mode 0600), the authorities' with the conductor.
namespace reachlab::network {

/// What a folder of certificates is.
struct PeerFolder {
  std::string name;
  bool conductor = false;  // holds the authorities
  bool complete = false;   // certificate and permissions are there
  std::string validUntil;  // of the certificate, as OpenSSL writes it; empty where there is none
  std::string fault;       // what is wrong with it, in words; empty: nothing
};

struct PeersOptions {
  int days = 3650;  // that certificates and permissions are valid
};

/// Makes the authorities and the conductor's own certificate in `folder`. Throws FaultError (a name that is none, a folder in use), ResourceError.
void initConductor(const std::string& folder, const std::string& name, const PeersOptions& options = {});
/// Makes a station's key and its request, `folder`/request.pem, which goes to the conductor.
void initStation(const std::string& folder, const std::string& name);
/// On the conductor: answers a request with what the station needs beside its key, in `folder`/for-NAME, which goes back to the station's folder.
/// Returns that folder.
std::string addStation(const std::string& folder, const std::string& request, const PeersOptions& options = {});
/// The folder itself and, on the conductor, whom it has answered.
std::vector<PeerFolder> listPeers(const std::string& folder);

}  // namespace reachlab::network
