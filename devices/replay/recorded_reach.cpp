#include "devices/replay/recorded_reach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/fault.h"
#include "base/json/json_tree.h"

namespace reachlab::devices {
namespace {

constexpr std::array<const char*, 2> kTimeUnits{"s", "ms"};
constexpr std::array<const char*, 3> kLengthUnits{"m", "cm", "mm"};

std::vector<std::string> cellsOf(std::string line, char separator) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> cells;
  std::istringstream in(line + separator);  // an empty last cell counts
  for (std::string cell; std::getline(in, cell, separator);) {
    const std::size_t begin = cell.find_first_not_of(' ');
    std::string bare = begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1);
    if (bare.size() >= 2 && bare.front() == '"' && bare.back() == '"') bare = bare.substr(1, bare.size() - 2);
    cells.push_back(std::move(bare));
  }
  return cells;
}

char separatorOf(const std::string& header) {
  if (header.find('\t') != std::string::npos) return '\t';
  return header.find(',') == std::string::npos && header.find(';') != std::string::npos ? ';' : ',';
}

struct Place {
  std::size_t column = 0;
  std::string name;
  double unit = 1;  // of the cell, in s or m
};

class Header {
 public:
  Header(std::vector<std::string> names, std::string file) : names_(std::move(names)), file_(std::move(file)) {}

  std::optional<std::size_t> find(const std::string& name) const {
    const auto at = std::find(names_.begin(), names_.end(), name);
    if (at == names_.end()) return std::nullopt;
    return static_cast<std::size_t>(at - names_.begin());
  }

  // A column that was named, its unit from what was said or from its name's ending.
  Place named(const std::string& name, const std::string& unit, bool time) const {
    const auto at = find(name);
    if (!at) throw FaultError(Fault{name, "column is missing", fmt::format("{}", fmt::join(names_, ", ")), FilePlace{file_, 1}});
    const std::size_t end = name.rfind('_');
    const std::string told = !unit.empty() ? unit : end == std::string::npos ? "" : name.substr(end + 1);
    const FilePlace header{file_, 1};
    return {*at, name, time ? secondsOfUnit(told, header, name) : metresOf(told, header, name)};
  }

  // One that is called by the quantity and its unit.
  template <std::size_t Count>
  Place called(const std::string& quantity, const std::array<const char*, Count>& units, bool time) const {
    for (const char* unit : units)
      if (find(quantity + "_" + unit)) return named(quantity + "_" + unit, unit, time);
    throw FaultError(Fault{quantity + "_" + units[0], "column is missing",
                           "a header with time_s,x_m,y_m,z_m (or time_ms, x_cm, x_mm …), or columns that are named (time=…, x=…, unit=…)",
                           FilePlace{file_, 1}});
  }
  std::size_t size() const { return names_.size(); }

 private:
  std::vector<std::string> names_;
  std::string file_;
};

struct Places {
  std::optional<Place> time;
  std::array<std::optional<Place>, 3> axes;
};

Places placesOf(const Header& header, const ReachColumns& columns) {
  Places places;
  if (!columns.time.empty()) places.time = header.named(columns.time, columns.timeUnit, true);
  else if (!columns.rate) places.time = header.called("time", kTimeUnits, true);
  const std::array<std::string, 3> named{columns.x, columns.y, columns.z};
  const bool plane = !named[0].empty() && !named[1].empty();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!named[k].empty()) places.axes[k] = header.named(named[k], columns.unit, false);
    else if (k < 2 || !plane) places.axes[k] = header.called(std::string(1, "xyz"[k]), kLengthUnits, false);
  }
  return places;
}

}  // namespace

RecordedReach readReach(const std::string& file, const ReachColumns& columns) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw ResourceError(file + ": cannot be opened");
  std::istringstream in(readTextFile(file));
  std::string line;
  std::getline(in, line);
  if (line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);
  const char separator = separatorOf(line);
  const Header header(cellsOf(line, separator), file);
  const Places places = placesOf(header, columns);

  RecordedReach reach;
  reach.file = file;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \r") == std::string::npos) continue;
    const std::vector<std::string> cells = cellsOf(line, separator);
    if (cells.size() != header.size())
      throw FaultError(
          Fault{{}, fmt::format("has {} cells", cells.size()), fmt::format("{}, as the header", header.size()), FilePlace{file, number}});
    const auto valueOf = [&](const Place& place) {
      const std::string& cell = cells[place.column];
      double value = 0;
      const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (fault != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        throw FaultError(
            Fault{place.name, fmt::format("'{}' is not a number", cell.substr(0, 40)), "a finite number", FilePlace{file, number}});
      return value * place.unit;
    };
    const double time = places.time ? valueOf(*places.time) : static_cast<double>(reach.time.size()) / *columns.rate;
    if (!reach.time.empty() && !(time > reach.time.back()))
      throw FaultError(Fault{places.time ? places.time->name : "time", "does not increase", "increasing times", FilePlace{file, number}});
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
      if (places.axes[k]) at[k] = valueOf(*places.axes[k]);
    reach.time.push_back(time);
    reach.position.push_back({at[0], at[1], at[2]});
  }
  if (reach.time.empty()) throw FaultError(Fault{{}, "has no samples", "at least one row", FilePlace{file}});
  return reach;
}

}  // namespace reachlab::devices
