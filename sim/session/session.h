#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/haptics/timing_check.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/run_log.h"
#include "sim/session/programme.h"
#include "sim/session/session_folder.h"

namespace reachlab::session {

/// What was asked for, by whatever front end.
struct SessionRequest {
  std::string what;  // experiment or plan, a file or a shipped name
  SessionPlace place;
  std::optional<int> trials, run, day;
  int trialsOnOffer = 1;  // of an experiment when `trials` is not given
  std::optional<std::uint64_t> seed;
  bool resume = false;
  bool fast = false, everyTick = false;
  std::string device;                                        // as asked for
  std::vector<std::string> instruments;                      // beside it, as asked for
  std::uint64_t diskReserve = 1'000'000'000;                 // [bytes] RecorderOptions::diskReserve
  double timingCheckSeconds = haptics::kTimingCheckSeconds;  // RecordedRunOptions::timingCheckSeconds
  record::Participant participant;
  std::string notes;
  std::string backup;  // second data folder, to which every finished run is copied; empty: none
};

/// What is worth a word before a session begins; each front end has its own.
struct SessionNotice {
  bool seedDrawn = false;               // by us, because none was given
  bool unfinished = false;              // an earlier run of this very session broke off, and this one does not resume it
  std::vector<std::string> unreadable;  // logs that are left out, a sentence each
};

/// One run to be done: the configuration lacks only what the scene, the device and the clock add.
struct BlockToRun {
  experiment::CompiledExperiment experiment;
  record::RunConfiguration configuration;
  std::string logPath;
  std::vector<trial::PlannedTrial> trials;  // still to be done, in order; numbered from configuration.firstTrial
  double restSeconds = 0;                   // [s] before it, at least, once the block before is done
  std::string instructions = {};            // of the plan, to be read before it begins
};

struct SessionToRun {
  std::vector<BlockToRun> blocks;  // empty: a resumed session has nothing left to do
  std::uint64_t seed = 0;
  SessionNotice notice;
};

/// Works out what is to be done: draws the order, chooses run numbers, and with `resume` leaves out what is on disk already. Throws
/// FaultError with every fault; those of the request have its member's name as key.
SessionToRun planSession(const SessionRequest& request, const Programme& programme);
/// The same for what `request.what` names.
SessionToRun planSession(const SessionRequest& request);

/// The plan's day that is asked for: the request's, else the session's label when that is a number; 0 where the plan has no days. Throws
/// FaultError.
int sessionDay(const SessionRequest& request, const Plan& plan);

/// Gives the block the next free run number where another program has taken its own since it was planned; one that was `askedFor` is
/// refused then (FaultError). Call it under a FolderHold that lasts until the log is created.
void takeFreeRun(BlockToRun& block, const SessionPlace& place, bool askedFor);

/// What is wrong with a seed's text, nothing when it is a whole number from 0 to 2^64 - 1; a sign or a larger number would be turned into another
/// seed without a word.
std::optional<Fault> seedFault(const std::string& text);
/// A seed for a session that was given none, from the system's entropy.
std::uint64_t drawSeed();

}  // namespace reachlab::session
