#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace reachlab::record {

/// A small table that is held column by column, for formats that are written so. It is filled cell by cell like TableText. One thread.
class ColumnTable {
 public:
  struct Column {
    std::string name;
    bool isText = false;  // its cells are in `texts`, otherwise in `numbers`
    std::vector<double> numbers = {};
    std::vector<std::string> texts = {};
  };

  explicit ColumnTable(const std::vector<std::string>& names) {
    for (const std::string& name : names) columns_.push_back({name});
  }
  ColumnTable& cell(std::string_view text) {
    Column& column = next();
    column.isText = true;
    column.texts.emplace_back(text);
    return *this;
  }
  ColumnTable& number(double value) {
    next().numbers.push_back(value);
    return *this;
  }
  ColumnTable& whole(long long value) { return number(static_cast<double>(value)); }
  void endRow() {
    at_ = 0;
    ++rows_;
  }
  const std::vector<Column>& columns() const { return columns_; }
  std::size_t rows() const { return rows_; }

 private:
  Column& next() { return columns_[at_++]; }
  std::vector<Column> columns_;
  std::size_t at_ = 0, rows_ = 0;
};

}  // namespace reachlab::record
