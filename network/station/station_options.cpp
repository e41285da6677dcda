#include "network/station/station_options.h"

#include <fmt/format.h>
#include <netdb.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/fault.h"
#include "base/system/helper_program.h"
#include "network/peers/peers.h"

namespace reachlab::network {
namespace {

std::string hostName() {
  char name[65] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "station";
}

// Keys are the requests' own.
std::string named(const char* key) { return std::string("--") + key; }

// The endpoint would only say that it cannot be made.
void requireCertificates(const std::string& folder) {
  const PeerFolder own = listPeers(folder).front();
  if (own.complete && own.fault.empty()) return;
  throw FaultError(Fault{"peers",
                         fmt::format("{}: {}", folder, own.fault.empty() ? "files of the conductor's answer are missing" : own.fault),
                         "a folder of which `reach peers list` says complete=yes and no fault"});
}

/// Cyclone DDS passes over an address that it does not know.
void requireAddress(const std::string& host) {
  addrinfo* found = nullptr;
  const bool hasPort = std::count(host.begin(), host.end(), ':') == 1;
  const int failed = ::getaddrinfo(host.substr(0, hasPort ? host.find(':') : host.size()).c_str(), nullptr, nullptr, &found);
  if (failed != 0) throw FaultError(Fault{"peer", fmt::format("is {}: {}", host, ::gai_strerror(failed)), "the address of a computer"});
  ::freeaddrinfo(found);
}

}  // namespace

void addStationOptions(CLI::App& command, StationSetup& setup) {
  StationOptions& link = setup.link;
  command.add_flag(named("conductor"), link.conductor, "Arms the trials and judges them for all; one station");
  auto* peers = command.add_option(named("peers"), link.secure, "Folder of this station's certificates (reach peers)");
  command.add_flag(named("insecure"), setup.insecure, "Without certificates and encryption: on a network of one's own")->excludes(peers);
  command.add_option(named("name"), link.name, "Name that the others see [default: the computer's]");
  command.add_option(named("interface"), link.interface, "Network interface [default: the system's choice]");
  command.add_option(named("peer"), link.peers, "Address of another station beyond this network; several times. No multicast then")
      ->allow_extra_args(false);
  command.add_option(named("domain"), link.domain, "Stations of one domain hear each other")
      ->check(CLI::Range(0, 230))
      ->capture_default_str();
  command.add_option(named("wait"), setup.wait, "Seconds to wait for the others")->check(CLI::Range(1.0, 86400.0))->capture_default_str();
  command
      .add_option(named("rate"), setup.rate, "How often a second this station's state is sent; less where the link or the computer is slow")
      ->check(CLI::IsMember({1000, 500, 250, 125}))
      ->capture_default_str();
}

void completeStationSetup(StationSetup& setup, const std::string& device, const std::string& program) {
  if (!setup.insecure && setup.link.secure.empty())
    throw FaultError(Fault{"peers", "are not told", "the folder of this station's certificates, or insecure in so many words"});
  if (!setup.insecure) requireCertificates(setup.link.secure);
  for (const std::string& peer : setup.link.peers) requireAddress(peer);
  if (setup.link.name.empty()) setup.link.name = hostName();
  setup.link.device = device;
  setup.link.software = "reachlab " REACHLAB_VERSION;
  setup.link.endpoint = findHelperProgram("reachlab-endpoint", program, "the program that speaks to the network");
}

}  // namespace reachlab::network
