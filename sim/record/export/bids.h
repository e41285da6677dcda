#pragma once
#include <string>
#include <vector>

#include "sim/record/log/atomic_file.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Writes one run as Motion-BIDS 1.9 into the dataset at `folder`. The files are motion, channels and events with their descriptions, the
/// experiment, and a line in the session's scans table. One run is one block, recorded continuously. Its trials are rows of events.tsv.
/// Returns the files written. Throws ResourceError.
std::vector<std::string> writeBidsRun(const RunLog& run, const std::string& folder);

/// Writes the files that describe the dataset as a whole: dataset_description.json, README.md, participants and sessions. A description or
/// README that exists is kept, since a person may have edited it. So are rows and columns that exist.
std::vector<std::string> writeBidsTables(const std::vector<RunConfiguration>& runs, const std::string& folder);

/// A sentence for each value of participants.tsv that this participant has otherwise, and that writeBidsTables keeps.
std::vector<std::string> keptOfParticipant(const std::string& folder, const std::string& subject, const Participant& participant);

/// Both, for these runs.
std::vector<std::string> writeBids(const std::vector<RunLog>& runs, const std::string& folder);

/// The file of a run's experiment in the dataset: code/experiments/…_experiment.json. BIDS does not describe this file, and motion.json
/// takes no further keys.
std::string experimentPath(const RunConfiguration& configuration);
/// The experiment as it was recorded, as an experiment file under `experiment`, with its constraint's definition, and the run's settings.
std::string experimentJson(const RunConfiguration& configuration);
/// Reads back the experiments of the run's scenes, in the order of `configuration`, by kind and target. A run of one scene has one. Throws
/// FaultError naming `origin`.
std::vector<experiment::CompiledExperiment> experimentsFromJson(const std::string& text, const std::string& origin,
                                                                const RunConfiguration& configuration);
/// TaskDescription of motion.json: the experiment's name, and sentences about object and task.
std::string describeTask(const RunConfiguration& configuration);
/// The experiment's name in such a description; empty where it is missing.
std::string experimentNameIn(const std::string& description);

// The texts of the files, for a caller that looks at them before they are written. Texts that grow with the run come piece by piece. Each
// hand is one tracking system, from 1. The object and channels that belong to no single hand are listed under the first hand.
void motionTsv(const RunLog& run, const TakePiece& take, int hand = 1);
std::string motionJson(const RunLog& run, int hand = 1);
std::string channelsTsv(const RunConfiguration& configuration, int hand = 1);
/// The path of a hand's motion files in the folder of their session, up to the run's number.
std::string motionPath(const RunConfiguration& configuration, int hand);
/// The columns of a hand's tracking system in the run's table.
std::vector<std::size_t> columnsOf(const ChannelTable& table, int hand);
std::string channelsJson();
void eventsTsv(const RunLog& run, const TakePiece& take);
std::string eventsJson(const RunLog& run);

}  // namespace reachlab::record
