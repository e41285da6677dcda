#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/study/chunk.h"

namespace reachlab::study {

/// A study's folder: study.json (the design as it was read, with the experiments' texts), chunks/, and in the end the tables.
struct StudyFolder {
  std::string path;
  Design design;
  ChunkPlan chunks;
  std::uint64_t fingerprint = 0;
};

/// Makes the folder of a design, or finds it there. Throws ResourceError: it cannot be written, or another study is in it.
StudyFolder makeFolder(const Design& design, const std::string& path);
/// Opens an existing folder. Throws FaultError.
StudyFolder openFolder(const std::string& path);

/// A share of the chunks: all chunks with chunk % of == index - 1.
struct Shard {
  int index = 1, of = 1;
  bool has(std::int64_t chunk) const { return chunk % of == index - 1; }
};
/// Missing chunks of the shard, in order. `there` is the number of existing chunks.
struct ChunksToDo {
  std::vector<std::int64_t> missing;
  std::int64_t there = 0;
};
ChunksToDo chunksToDo(const StudyFolder& folder, const Shard& shard = {});

/// The tables, from all chunks in order: trials.csv.gz, trials.json, trials.h5. False where chunks are missing, and nothing is written.
bool mergeTables(const StudyFolder& folder);
bool areTablesThere(const StudyFolder& folder);

/// The progress of a study by the files in its folder.
struct StudyStatus {
  std::int64_t chunks = 0, chunksDone = 0, trials = 0, trialsDone = 0;
  double rate = 0;         // [trials/s] of the chunks of the last hour that work went on, 0: unknown
  double secondsLeft = 0;  // by that rate; 0: none, or unknown
  bool tables = false;
};
StudyStatus statusOf(const StudyFolder& folder);

}  // namespace reachlab::study
