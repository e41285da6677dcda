#pragma once
#include "network/station/station_run.h"

namespace CLI {
class App;
}  // namespace CLI

namespace reachlab::network {

/// The options of a station, which are the same for every front end: conductor, peers, insecure, name, interface, peer, domain, wait, rate.
/// The front end adds the options for the hand and its device. `setup` outlives the parsing.
void addStationOptions(CLI::App& command, StationSetup& setup);

/// Called after the parsing. Completes the options that were not given, and the values that belong to the computer. `program` is the
/// program that starts the endpoint, for the message. Throws FaultError without valid certificates and without `insecure`. Throws ResourceError
/// without an endpoint.
void completeStationSetup(StationSetup& setup, const std::string& device, const std::string& program);

}  // namespace reachlab::network
