#pragma once
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace reachlab {

/// A table as text, cell by cell, with the same bytes in every locale. Numbers read back equal.
class TableText {
 public:
  /// `missing` is the text for an unknown value (a number that is not finite).
  TableText(char separator, std::string missing) : separator_(separator), missing_(std::move(missing)) {}

  /// Quoted for CSV where necessary, and guarded by ' if it begins with = + - @. In TSV, tabs and line ends become spaces.
  TableText& cell(std::string_view text);
  TableText& number(double value);
  TableText& whole(long long value);
  TableText& missing() { return raw(missing_); }
  void endRow();
  void row(const std::vector<std::string>& cells);
  /// Cells by their types: texts, whole numbers (true is 1), other numbers. An optional value that is not there is a missing value.
  template <class... Cells>
  TableText& cells(const Cells&... values) {
    return (add(values), ..., *this);
  }
  template <class... Cells>
  void row(const Cells&... values) {
    cells(values...).endRow();
  }
  const std::string& text() const { return text_; }
  /// Returns the text so far and forgets it, so that a long table can be written to its file piece by piece.
  std::string takeText() { return std::exchange(text_, {}); }

 private:
  TableText& raw(std::string_view text);
  template <class Cell>
  void add(const Cell& value) {
    if constexpr (std::is_convertible_v<const Cell&, std::string_view>) cell(std::string_view(value));
    else if constexpr (std::is_integral_v<Cell>) whole(static_cast<long long>(value));
    else if constexpr (std::is_floating_point_v<Cell>) number(value);
    else if (value) add(*value);
    else missing();
  }
  char separator_;
  std::string missing_, text_;
  bool rowBegun_ = false;
};

/// A TSV file: the header, and rows with as many cells. Throws nothing. A short row is filled with n/a.
struct TsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
TsvTable parseTsv(const std::string& text);
std::string toText(const TsvTable& table);

}  // namespace reachlab
