#pragma once
#include <string>
#include <vector>

/// The members of a laboratory, as DDS Security needs them. Each station has a key, a certificate and signed permissions. There are two
/// authorities, because with a single authority a station could sign permissions for itself. Each key stays where it is made: a station's
/// key on the station (mode 0600), the authorities' keys with the conductor.
namespace reachlab::network {

/// The contents of a folder of certificates.
struct PeerFolder {
  std::string name;
  bool conductor = false;  // holds the authorities
  bool complete = false;   // certificate and permissions are there
  std::string validUntil;  // of the certificate, as OpenSSL writes it; empty without a certificate
  std::string fault;       // the error in the folder as text; empty: no error
};

struct PeersOptions {
  int days = 3650;  // validity of certificates and permissions
};

/// Makes the authorities and the conductor's certificate in `folder`. Throws FaultError (an impossible name, a folder in use) or
/// ResourceError.
void initConductor(const std::string& folder, const std::string& name, const PeersOptions& options = {});
/// Makes a station's key and its request, `folder`/request.pem. The request goes to the conductor.
void initStation(const std::string& folder, const std::string& name);
/// On the conductor. Answers a request with all files that the station needs besides its key, in `folder`/for-NAME. These files go back to
/// the station's folder. Returns the folder.
std::string addStation(const std::string& folder, const std::string& request, const PeersOptions& options = {});
/// The folder itself and, on the conductor, the stations with an answer.
std::vector<PeerFolder> listPeers(const std::string& folder);

}  // namespace reachlab::network
