#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <vector>

namespace reachlab::analysis {

/// Keeps numbers row by row. A few stay in memory, and more go to a nameless temporary file. So memory does not grow with the number of
/// trials. One thread at a time.
class SignalStore {
 public:
  /// The position of a row.
  struct Row {
    std::size_t place = 0;
    std::uint32_t size = 0;
  };
  explicit SignalStore(std::size_t mostInMemory = std::size_t{1} << 17) : most_(mostInMemory) {}  // numbers

  /// Throws ResourceError when the temporary file cannot be written.
  Row put(std::span<const double> values);
  std::vector<double> get(Row row) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::size_t most_, stored_ = 0;
  std::vector<double> memory_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace reachlab::analysis
