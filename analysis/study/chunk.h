#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/study/columns.h"

/// A study is computed in chunks of whole subjects, since a learner's trials depend on one another. A chunk that is there is done: it is
/// written under another name, synced and renamed. The same design gives the same chunks on every computer and in every order.
namespace reachlab::study {

/// Pairs of point and subject (point * subjects + subject - 1) of a chunk: [first, end).
struct PairRange {
  std::int64_t first = 0, end = 0;
};

/// The division of a design into chunks. It depends on the design's size alone, never on the computer.
struct ChunkPlan {
  std::int64_t pairs = 0, pairsPerChunk = 1;
  std::int64_t count() const { return (pairs + pairsPerChunk - 1) / pairsPerChunk; }
  PairRange at(std::int64_t chunk) const {
    const std::int64_t first = chunk * pairsPerChunk;
    return {first, first + pairsPerChunk < pairs ? first + pairsPerChunk : pairs};
  }
};
ChunkPlan planChunks(const Design& design);

/// Rows of a chunk, as compressed text and as numbers, column by column. Each text is a whole gzip member, so that texts can be joined.
struct ChunkRows {
  std::int64_t rows = 0;
  std::size_t columns = 0;
  std::vector<double> values;   // values[column * rows + row]
  std::vector<float> profiles;  // kProfileNumbers a row, NaN where there is no movement; empty: none are kept
  std::string csvGz;
};

/// Tells designs apart that must not share a folder: everything that changes a byte of a table, and the program's version.
std::uint64_t fingerprintOf(const Design& design);

/// "OUT/chunks/000/00000012.chunk".
std::string chunkPath(const std::string& out, std::int64_t chunk);
/// True when the chunk is there, whole, and of this design. Throws ResourceError where one of another design is there.
bool isChunkThere(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint);
/// Throws ResourceError.
void writeChunk(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint, const ChunkRows& rows);
/// Throws ResourceError when it is damaged, with the remedy.
ChunkRows readChunk(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint);

}  // namespace reachlab::study
