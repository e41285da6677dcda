#include "devices/replay/recorded_reach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/csv_table.h"
#include "base/fault.h"
#include "devices/replay/reach_checks.h"

namespace reachlab::devices {
namespace {

constexpr std::array<const char*, 2> kTimeUnits{"s", "ms"};
constexpr std::array<const char*, 3> kLengthUnits{"m", "cm", "mm"};

struct Place {
  std::size_t column = 0;
  std::string name;
  double unit = 1;  // of the cell, in s or m
};

class Header {
 public:
  explicit Header(const CsvTable& table) : table_(table) {}

  // A column that was named, its unit from what was said or from its name's ending.
  Place named(const std::string& name, const std::string& unit, bool time) const {
    const FilePlace header{table_.file, 1};
    const auto at = table_.find(name);
    if (!at) refuse(header, "column is missing", fmt::format("{}", fmt::join(table_.columns, ", ")), name);
    const std::size_t end = name.rfind('_');
    const std::string told = !unit.empty() ? unit : end == std::string::npos ? "" : name.substr(end + 1);
    return {*at, name, time ? secondsOfUnit(told, header, name) : metresOf(told, header, name)};
  }

  template <std::size_t Count>
  bool calls(const std::string& quantity, const std::array<const char*, Count>& units) const {
    return std::any_of(units.begin(), units.end(), [&](const char* unit) { return table_.find(quantity + "_" + unit).has_value(); });
  }
  // One that is called by the quantity and its unit.
  template <std::size_t Count>
  Place called(const std::string& quantity, const std::array<const char*, Count>& units, bool time) const {
    for (const char* unit : units)
      if (table_.find(quantity + "_" + unit)) return named(quantity + "_" + unit, unit, time);
    refuse({table_.file, 1}, "column is missing",
           "a header with time_s,x_m,y_m,z_m (or time_ms, x_cm, x_mm …), or columns that are named (time=…, x=…, unit=…)",
           quantity + "_" + units[0]);
  }

 private:
  const CsvTable& table_;
};

struct Places {
  std::optional<Place> time;
  std::array<std::optional<Place>, 3> axes;
};

Places placesOf(const Header& header, const ReachColumns& columns, const std::string& file) {
  Places places;
  if (!columns.time.empty()) places.time = header.named(columns.time, columns.timeUnit, true);
  else if (!columns.rate || header.calls("time", kTimeUnits)) places.time = header.called("time", kTimeUnits, true);
  const std::array<std::string, 3> named{columns.x, columns.y, columns.z};
  const bool plane = !named[0].empty() && !named[1].empty();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!named[k].empty()) places.axes[k] = header.named(named[k], columns.unit, false);
    else if (k < 2 || !plane) places.axes[k] = header.called(std::string(1, "xyz"[k]), kLengthUnits, false);
  }
  if (columns.rate && places.time) refuse({file, 1}, "is there beside rate=", "one of them", places.time->name);
  return places;
}

// Of a sample in which the point was not seen, as spreadsheets, MATLAB, R, and BIDS write it.
bool isMissingCell(const std::string& cell) { return cell.empty() || cell == "NaN" || cell == "nan" || cell == "NA" || cell == "n/a"; }

}  // namespace

RecordedReach readReach(const std::string& file, const ReachColumns& columns) {
  const CsvTable table = readCsvTable(file);
  const Places places = placesOf(Header(table), columns, file);

  if (table.rows.empty()) refuse({file}, "has no samples", "at least one row");
  SeenSamples reach(file);
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const CsvTable::Row& row = table.rows[i];
    const auto valueOf = [&](const Place& place) { return numberIn(table, row, place.column) * place.unit; };
    const double time = places.time ? valueOf(*places.time) : static_cast<double>(i) / *columns.rate;
    if (!(time > last)) refuse({file, row.line}, "does not increase", "increasing times", places.time ? places.time->name : "time");
    last = time;
    const auto isMissing = [&](const std::optional<Place>& axis) { return axis && isMissingCell(row.cells[axis->column]); };
    if (std::any_of(places.axes.begin(), places.axes.end(), isMissing)) continue;
    std::array<double, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
      if (places.axes[k]) at[k] = valueOf(*places.axes[k]);
    reach.add(time, {at[0], at[1], at[2]});
  }
  return reach.take();
}

}  // namespace reachlab::devices
