#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

/// Several stations' logs of one run, made into one: the conductor's ticks, object and outcomes, every hand from its own station's log at the
/// same moment.
namespace reachlab::network {

/// One station's log, and what came of reading it.
struct MergedStation {
  std::string log;
  int station = 0;  // from 1
  bool conductor = false;
  std::uint64_t ticks = 0, samples = 0;  // recorded; of the others, as given to its copy
  bool identical = false;                // its copy was computed again from its own log, to the bit
  std::string firstDifference;
  int otherOutcomes = 0;    // trials that ended in another way than at the conductor
  double offset = 0;        // [s] its clock less the conductor's, the median over the run
  double offsetSpread = 0;  // [s] between the 5th and the 95th percentile
  double apart = 0;         // [m] RMS over the movement: its copy against the others'
};
struct MergeReport {
  std::vector<MergedStation> stations;  // by number
  std::uint64_t rows = 0;               // of the merged recording
  int trials = 0;
};

/// Whose log it is, from 1; 0 where it is of no station.
int stationOf(const record::RunLog& log);
/// True for what `mergeStations` has written: it is no run of one engine, and each station's log is beside it.
bool isMerged(const record::RunLog& log);
/// The stations' logs that a merged one was made from, as `mergeStations` keeps them.
std::vector<std::string> logsOfMerged(const record::RunLog& log);

/// Writes the merged log to `configuration.run`'s place `path`, with the channels of every station's links, and copies of the logs
/// into the folder `stations` beside it. `configuration` names subject, session and run; the rest is the conductor's. Throws
/// FaultError: not one log of each of the experiment's stations, no or two conductors, different experiments, clocks that contradict
/// each other, a log whose copy is another when it is computed again.
MergeReport mergeStations(const std::vector<std::string>& logs, const record::RunConfiguration& configuration, const std::string& path);

}  // namespace reachlab::network
