#pragma once
#include <span>
#include <string>
#include <string_view>

namespace reachlab::record {

/// What a column of a CSV file holds, in words. A name that ends in `*` stands for all columns that begin with it.
struct ColumnMeaning {
  std::string_view column, meaning = {};
};

/// The dictionary that lies beside a CSV file, as BIDS describes tables: for each column of the header its Description, and Units where
/// it has any (told by the ending of its name). Subject and session are labels that must be read as text. A column that is not in
/// `meanings` is given with an empty description, which the tests forbid.
std::string columnDictionary(std::string_view csv, std::span<const ColumnMeaning> meanings);
/// "hand_vx_m_per_s" is in m/s; empty for names without a unit.
std::string unitOfColumn(std::string_view column);
/// "folder/trials.csv" has its dictionary in "folder/trials.json".
std::string dictionaryPathOf(const std::string& csvPath);

}  // namespace reachlab::record
