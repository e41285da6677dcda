#pragma once
#include <cstdint>
#include <string>

namespace reachlab::cli {

/// How far long work is, on stderr: a line that is rewritten on a terminal. In a log or a pipe there are lines, less and less often.
class ProgressLine {
 public:
  ProgressLine();
  bool onTerminal() const { return terminal_; }
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
