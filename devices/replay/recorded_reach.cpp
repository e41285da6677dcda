#include "devices/replay/recorded_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/fault.h"
#include "base/json_tree.h"

namespace reachlab::devices {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"time_s", "x_m", "y_m", "z_m"};

std::vector<std::string> cellsOf(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream in(line + ",");  // an empty last cell counts
  for (std::string cell; std::getline(in, cell, ',');) {
    const std::size_t begin = cell.find_first_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return cells;
}

}  // namespace

RecordedReach readReach(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw ResourceError(file + ": cannot be opened");
  std::istringstream in(readTextFile(file));
  std::string line;
  std::getline(in, line);
  if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
  const std::vector<std::string> header = cellsOf(line);
  std::array<std::size_t, 4> place{};
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    place[k] = static_cast<std::size_t>(std::find(header.begin(), header.end(), kColumns[k]) - header.begin());
    if (place[k] == header.size())
      throw FaultError(Fault{std::string(kColumns[k]), "column is missing", "a header with time_s,x_m,y_m,z_m", FilePlace{file, 1}});
  }

  RecordedReach reach;
  reach.file = file;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \r") == std::string::npos) continue;
    const std::vector<std::string> cells = cellsOf(line);
    if (cells.size() != header.size())
      throw FaultError(
          Fault{{}, fmt::format("has {} cells", cells.size()), fmt::format("{}, as the header", header.size()), FilePlace{file, number}});
    std::array<double, 4> row{};
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string& cell = cells[place[k]];
      const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), row[k]);
      if (fault != std::errc() || end != cell.data() + cell.size() || !std::isfinite(row[k]))
        throw FaultError(Fault{std::string(kColumns[k]), fmt::format("'{}' is not a number", cell.substr(0, 40)), "a finite number",
                               FilePlace{file, number}});
    }
    if (!reach.time.empty() && !(row[0] > reach.time.back()))
      throw FaultError(Fault{"time_s", "does not increase", "increasing times", FilePlace{file, number}});
    reach.time.push_back(row[0]);
    reach.position.push_back({row[1], row[2], row[3]});
  }
  if (reach.time.empty()) throw FaultError(Fault{{}, "has no samples", "at least one row", FilePlace{file}});
  return reach;
}

}  // namespace reachlab::devices
