#pragma once
#include <string>
#include <string_view>
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
  TableText& cell(const char* text) { return cell(std::string_view(text)); }
  TableText& cell(const std::string& text) { return cell(std::string_view(text)); }
  TableText& number(double value);
  TableText& whole(long long value);
  TableText& missing() { return raw(missing_); }
  void endRow();
  void row(const std::vector<std::string>& cells);
  const std::string& text() const { return text_; }
  /// Returns the text so far and forgets it, so that a long table can be written to its file piece by piece.
  std::string takeText() { return std::exchange(text_, {}); }

 private:
  TableText& raw(std::string_view text);
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
