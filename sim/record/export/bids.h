#pragma once
#include <string>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes one run as Motion-BIDS 1.9 into the dataset at `folder`: motion, channels and events, each with its description, its experiment, and
/// its line in the session's scans table. One run is one block, recorded continuously; trials are rows of events.tsv. Returns the
/// files written. Throws ResourceError.
std::vector<std::string> writeBidsRun(const RunLog& run, const std::string& folder);

/// Writes what describes the dataset as a whole: dataset_description.json and README.md (only where there is none, a person may
/// have edited them), participants and sessions. Rows and columns that are there already are kept.
std::vector<std::string> writeBidsTables(const std::vector<RunConfiguration>& runs, const std::string& folder);

/// Both, for these runs.
std::vector<std::string> writeBids(const std::vector<RunLog>& runs, const std::string& folder);

/// Where a run's experiment lies in the dataset: code/experiments/…_experiment.json, beside what BIDS knows of (motion.json takes no keys of
/// our own).
std::string experimentPath(const RunConfiguration& configuration);
/// The experiment as it was recorded, as an experiment file under `experiment`, with its constraint's definition, and the run's settings.
std::string experimentJson(const RunConfiguration& configuration);
/// Reads it back. Throws FaultError naming `origin`.
experiment::CompiledExperiment experimentFromJson(const std::string& text, const std::string& origin);
/// TaskDescription of motion.json: the experiment's name, and in words what was moved and asked.
std::string describeTask(const RunConfiguration& configuration);
/// The experiment's name in such a description; empty where there is none.
std::string experimentNameIn(const std::string& description);

// The texts of the files, for who wants to look at them before they are written; what grows with the run is given piece by piece.
// Each hand is a tracking system of its own, from 1; the object and what is no hand's belong to the first.
void motionTsv(const RunLog& run, const TakePiece& take, int hand = 1);
std::string motionJson(const RunLog& run, int hand = 1);
std::string channelsTsv(const RunConfiguration& configuration, int hand = 1);
/// The columns of a hand's tracking system in the run's table.
std::vector<std::size_t> columnsOf(const ChannelTable& table, int hand);
std::string channelsJson();
void eventsTsv(const RunLog& run, const TakePiece& take);
std::string eventsJson(const RunLog& run);

}  // namespace reachlab::record
