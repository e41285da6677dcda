#pragma once
#include <unistd.h>

#include <filesystem>
#include <string>

#include "analysis/study/points.h"
#include "analysis/study/study_folder.h"

/// Folders of studies whose chunks are written by hand.
namespace reachlab::study {

/// A folder of its own, gone with the object.
class OwnFolder {
 public:
  OwnFolder() {
    static int count = 0;
    path_ =
        (std::filesystem::temp_directory_path() / ("reachlab_study_" + std::to_string(getpid()) + "_" + std::to_string(count++))).string();
    std::filesystem::create_directories(path_);
  }
  ~OwnFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

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
