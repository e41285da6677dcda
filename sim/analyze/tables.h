#pragma once
#include <map>
#include <string>

#include "sim/analyze/study.h"

namespace reachlab::analyze {

/// The study as tidy CSV files, by file name (docs/analysis.md has their columns). Every number of a figure or of the report is in one.
/// Numbers read back equal; an empty cell is what could not be measured.
std::map<std::string, std::string> makeTables(const StudyResult& study);

/// What each column of one of these files is, in words, with its unit; empty for a file that is none of them.
std::string tableDictionary(const std::string& name, const std::string& csv);

/// "(1) min-hand-jerk", with the paper's number; "(3h)" is the literal hand-crackle variant.
std::string numberedName(predict::Criterion criterion);
/// The name with underscores, for columns.
std::string columnOf(predict::Criterion criterion);
/// A condition's name as part of a file name: letters, digits and dashes.
std::string fileNameOf(const std::string& condition);

}  // namespace reachlab::analyze
