#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/record/run_configuration.h"
#include "sim/record/run_log.h"
#include "sim/session/plan.h"
#include "sim/session/session_folder.h"

namespace reachlab::session {

/// What was asked for on the command line or in the window.
struct SessionRequest {
  std::string what;  // experiment or plan, a file or a shipped name
  SessionPlace place;
  std::optional<int> trials, run, day;
  int trialsOnOffer = 1;  // of an experiment when `trials` is not given
  std::optional<std::uint64_t> seed;
  bool resume = false;
  bool fast = false, everyTick = false;
  std::string device;                         // as asked for
  std::uint64_t diskReserve = 1'000'000'000;  // [bytes] RecorderOptions::diskReserve
  record::Participant participant;
  std::string notes;
};

/// One run to be done: the configuration lacks only what the scene, the device and the clock add.
struct BlockToRun {
  experiment::Experiment experiment;
  record::RunConfiguration configuration;
  std::string logPath;
  std::vector<trial::PlannedTrial> trials;  // still to be done, in order; numbered from configuration.firstTrial
  int blocksAfter = 0;                      // of the same session
};

struct SessionToRun {
  std::vector<BlockToRun> blocks;  // empty: a resumed session has nothing left to do
  std::uint64_t seed = 0;
  bool seedDrawn = false;  // by us, because none was given: to be printed
  std::string hint;        // one sentence for the experimenter, or empty
};

/// Works out what is to be done: reads plan and experiments, draws the order, chooses run numbers, and with `resume` leaves out
/// what is on disk already. Throws UsageError with every fault.
SessionToRun planSession(const SessionRequest& request);

/// Gives the block the next free run number where another program has taken its own since it was planned; one that was asked for is refused
/// then (UsageError). Call it under a FolderHold that lasts until the log is created.
void takeFreeRun(BlockToRun& block, const SessionRequest& request);

/// A seed for a session that was given none, from the system's entropy.
std::uint64_t drawSeed();

}  // namespace reachlab::session
