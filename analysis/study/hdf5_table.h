#pragma once
#include <memory>
#include <string>
#include <vector>

#include "analysis/study/chunk.h"

namespace reachlab::study {

/// trials.h5: a group /trials with a dataset for each column, all of one length. Each has a `Description` and `Units`. Text is stored as
/// codes, and the attribute `words` has the texts. /profiles/hand_m_per_s and object_m_per_s have 101 points per trial if profiles are
/// kept. No times are stored, so the same rows give the same bytes. The file is written under another name until commit. Without commit
/// no file is left. Throws ResourceError. One thread.
class Hdf5Table {
 public:
  Hdf5Table(const std::string& path, const std::vector<Column>& columns, const std::string& dictionary, std::size_t profileNumbers);
  ~Hdf5Table();
  Hdf5Table(const Hdf5Table&) = delete;
  Hdf5Table& operator=(const Hdf5Table&) = delete;

  void append(const ChunkRows& rows);
  void commit();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace reachlab::study
