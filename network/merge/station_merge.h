#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

/// Merges several stations' logs of one run. Ticks, object and outcomes are the conductor's. Every hand comes from its station's log at the
/// same moment.
namespace reachlab::network {

/// One station's log and the results of reading it.
struct MergedStation {
  int station = 0;  // from 1
  bool conductor = false;
  std::uint64_t ticks = 0, samples = 0;  // recorded ticks; samples of other stations, as given to its copy
  int otherOutcomes = 0;                 // trials with another outcome than at the conductor
  double offset = 0;                     // [s] its clock less the conductor's, the median over the run
  double offsetSpread = 0;               // [s] between the 5th and the 95th percentile
  double apart = 0;                      // [m] RMS over the movement: its copy against the other copies
};
struct MergeReport {
  std::vector<MergedStation> stations;  // by number
  std::uint64_t rows = 0;               // of the merged recording
  int trials = 0;
  int cutOff = 0;  // trials of the conductor that are missing or interrupted here, because the log of a station ends before
};

/// The station of a log, from 1. 0 for a log without a station.
int stationOf(const record::RunLog& log);
/// True for a log that `mergeStations` has written. It is no run of a single engine, and each station's log is beside it.
bool isMerged(const record::RunLog& log);
/// The stations' logs that a merged one was made from, as `mergeStations` keeps them.
std::vector<std::string> logsOfMerged(const record::RunLog& log);

/// Writes the merged log to the path `path` of `configuration.run`, with the channels of every station's links. Copies the logs into the
/// folder `stations` beside it. `configuration` names subject, session and run. All other values are the conductor's. Nothing is left of a
/// merge that fails. Throws FaultError when a station's log is missing or doubled, when no station or two stations conducted, and when a
/// station was started again. Also for different experiments, for contradicting clocks, and for a log whose copy differs when it is computed
/// again.
MergeReport mergeStations(const std::vector<std::string>& logs, const record::RunConfiguration& configuration, const std::string& path);

}  // namespace reachlab::network
