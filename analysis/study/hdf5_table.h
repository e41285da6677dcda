#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/study/chunk.h"

namespace reachlab::study {

/// Writes trials.h5: a group /trials with a dataset for each column, all of one length. Each has a `Description` and `Units`. Text is stored
/// as codes, and the attribute `words` has the texts. /profiles/hand_m_per_s and object_m_per_s have 101 points per trial if profiles are
/// kept. No times are stored, so the same rows give the same bytes. `nextRows` gives one chunk at each call, and nullopt at the end.
/// The file appears when it is complete. After an exception no file is left. Throws ResourceError. One thread.
void writeHdf5Table(const std::string& path, const std::vector<Column>& columns, const std::string& dictionary, std::size_t profileNumbers,
                    const std::function<std::optional<ChunkRows>()>& nextRows);

}  // namespace reachlab::study
