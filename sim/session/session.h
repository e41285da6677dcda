#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "sim/haptics/timing_check.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/run_log.h"
#include "sim/session/programme.h"
#include "sim/session/session_folder.h"

namespace reachlab::session {

/// The request of a front end.
struct SessionRequest {
  std::string what;  // experiment or plan, a file or a shipped name
  SessionPlace place;
  std::optional<int> trials, run, day;
  int trialsOnOffer = 1;  // of an experiment when `trials` is not given
  std::optional<std::uint64_t> seed;
  bool resume = false;
  bool fast = false, everyTick = false;
  std::string device;                                        // as requested
  std::vector<std::string> instruments;                      // beside it, as requested
  std::uint64_t diskReserve = 1'000'000'000;                 // [bytes] RecorderOptions::diskReserve
  double timingCheckSeconds = haptics::kTimingCheckSeconds;  // RecordedRunOptions::timingCheckSeconds
  record::Participant participant;
  std::string notes;
  std::string backup;  // second data folder, to which every finished run is copied. Empty: no copy
};

/// Warnings before a session begins. Each front end words them itself.
struct SessionNotice {
  bool seedDrawn = false;            // drawn because the request has no seed
  std::string deviceBefore;          // of the session that this request resumes, where it asks for another device. Empty: the same
  bool unfinished = false;           // an earlier run of this session broke off, and this request does not resume it
  bool again = false;                // blocks of this plan are recorded already, and this request does not resume it
  bool nothingToResume = false;      // this request resumes a session of which nothing is recorded
  std::vector<std::string> leftOut;  // logs that are not read, and values of the participant that the table has otherwise
};

/// One run to be recorded. Its configuration lacks only the values that the scene, the device and the clock add.
struct BlockToRun {
  experiment::CompiledExperiment experiment;
  std::vector<experiment::CompiledExperiment> scenes;  // of PlannedTrial::scene; a block without kinds and targets has `experiment` alone
  record::RunConfiguration configuration;
  std::string logPath;
  std::vector<trial::PlannedTrial> trials;  // still to be done, in order, and numbered from configuration.firstTrial
  std::size_t repeats = 0;                  // the last so many of `trials` repeat aborted ones, and are not repeated again
  double restSeconds = 0;                   // [s] at least, between the end of the block before and this block
  std::string instructions = {};            // of the plan, to be read before it begins
};

struct SessionToRun {
  std::deque<BlockToRun> blocks;  // still to be opened; empty: a resumed session is complete
  std::uint64_t seed = 0;
  SessionNotice notice;
};

/// Plans the session: draws the order, chooses run numbers, and with `resume` leaves out recorded trials. Throws FaultError with every
/// fault. The key of a fault of the request is its member's name.
SessionToRun planSession(const SessionRequest& request, const Programme& programme);

/// Throws FaultError where a recording of this programme could not be read again. planSession checks the same.
void checkRecordable(const Programme& programme);
/// The requested day of the plan: `request.day`, else the session's label when that is a number. 0 where the plan has no days. Throws
/// FaultError.
int sessionDay(const SessionRequest& request, const Plan& plan);

/// Gives the block the next free run number where another program has taken its number since it was planned. A number that was `askedFor`
/// is refused then (FaultError). Keep holdDataset until the log is created.
void takeFreeRun(BlockToRun& block, const SessionPlace& place, bool askedFor);

/// The fault of a seed's text in one sentence: it must be a whole number from 0 to 2^64 - 1. A sign or a larger number would silently become
/// another seed. Empty for a seed.
std::string seedFault(const std::string& text);
/// A seed from the system's entropy, for a session without a given seed.
std::uint64_t drawSeed();

}  // namespace reachlab::session
