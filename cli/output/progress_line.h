#pragma once
#include <cstdint>
#include <string>

namespace reachlab::cli {

/// How far long work is, on stderr: a line that is rewritten on a terminal. In a log or a pipe it is a line less and less often, so that a
/// log stays short and who reads a pipe is told.
class ProgressLine {
 public:
  /// Work that is shorter than `quiet` leaves no line in a log. [s]
  explicit ProgressLine(double quiet = 0);
  void tell(std::string words);
  /// Shows what was told last, and leaves its line.
  void end();

 private:
  void show();
  bool terminal_, shown_ = false;
  std::int64_t begunNs_, nextNs_;
  std::string words_;  // that are not shown yet
};

}  // namespace reachlab::cli
