#pragma once
#include <memory>
#include <string>
#include <vector>

#include "analysis/study/chunk.h"

namespace reachlab::study {

/// trials.h5: a group /trials with one dataset a column, all of one length; text as codes with their words in the attribute `words`; each
/// with its `Description` and `Units`. /profiles/hand_m_per_s and object_m_per_s, 101 points a trial, where they are kept. No times are
/// stored, so the same rows give the same bytes. Written under another name and put in place by commit; without it nothing is left.
/// Throws ResourceError. One thread.
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
