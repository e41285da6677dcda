#pragma once
#include <filesystem>
#include <string>

#include "analysis/study/points.h"
#include "analysis/study/study_folder.h"
#include "tests/temporary_folder.h"

/// Folders of studies whose chunks are written by hand.
namespace reachlab::study {

/// Rows by row, turned into a chunk's columns.
inline ChunkRows chunkOf(const std::vector<std::vector<double>>& rows) {
  ChunkRows out;
  out.rows = static_cast<std::int64_t>(rows.size());
  out.columns = rows.front().size();
  for (std::size_t c = 0; c < out.columns; ++c)
    for (const auto& row : rows) out.values.push_back(row[c]);
  out.csvGz = "rows";
  return out;
}

}  // namespace reachlab::study
