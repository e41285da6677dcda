#pragma once
#include "network/station/station_run.h"

namespace CLI {
class App;
}  // namespace CLI

namespace reachlab::network {

/// The options of a station, which are the same wherever one is begun: conductor, peers, insecure, name, interface, peer, domain, wait, rate.
/// Which hand is here and its device are the front end's own. `setup` outlives the parsing.
void addStationOptions(CLI::App& command, StationSetup& setup);

/// After the parsing: what was not given, and what is the computer's own. `program`: who starts the endpoint, for the fault. Throws FaultError:
/// neither certificates nor insecure; ResourceError: there is no endpoint.
void completeStationSetup(StationSetup& setup, const std::string& device, const std::string& program);

}  // namespace reachlab::network
