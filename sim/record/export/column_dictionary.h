#pragma once
#include <span>
#include <string>
#include <string_view>

namespace reachlab::record {

/// The meaning of a column of a CSV file, as a sentence. A name that ends in `*` stands for all columns that begin with it.
struct ColumnMeaning {
  std::string_view column, meaning = {};
};

/// The dictionary beside a CSV file, in the form that BIDS has for tables. Each column of the header has its Description, and Units where
/// the ending of its name gives a unit. Subject and session are labels that must be read as text. A column that is not in `meanings` is
/// given with an empty description, which the tests forbid.
std::string columnDictionary(std::string_view csv, std::span<const ColumnMeaning> meanings);
/// The unit in a name: "hand_vx_m_per_s" is in m/s. Empty for names without a unit.
std::string unitOfColumn(std::string_view column);
/// "folder/trials.csv" has its dictionary in "folder/trials.json".
std::string dictionaryPathOf(const std::string& csvPath);

}  // namespace reachlab::record
