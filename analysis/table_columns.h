#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/export/column_dictionary.h"

namespace reachlab::analysis {

/// The columns of a file that an analysis writes, in order, each with its sentence. Empty for an unknown file. A name that ends in `*`
/// means a column for each criterion. Header and dictionary of a file both follow from this.
std::span<const record::ColumnMeaning> tableColumns(std::string_view file);

}  // namespace reachlab::analysis
