#include "cli/output/progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "base/system/os.h"

namespace reachlab::cli {
namespace {

constexpr std::int64_t kTerminalPeriodNs = 250'000'000, kLeastPeriodNs = 1'000'000'000;
constexpr std::int64_t kShareOfTime = 20;  // the period in a log is a twentieth of the time that has passed

}  // namespace

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0), begunNs_(os::now()), nextNs_(begunNs_) {}

void ProgressLine::tell(std::string words) {
  words_ = std::move(words);
  if (os::now() >= nextNs_) show();
}

void ProgressLine::end() {
  if (!words_.empty() && (terminal_ || shown_)) show();
  if (!terminal_ || !shown_) return;
  fmt::print(stderr, "\n");
  shown_ = false;
}

void ProgressLine::show() {
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r" : "", words_, terminal_ ? "\033[K" : "\n");
  words_.clear();
  shown_ = true;
  const std::int64_t now = os::now();
  nextNs_ = now + (terminal_ ? kTerminalPeriodNs : std::max(kLeastPeriodNs, (now - begunNs_) / kShareOfTime));
}

}  // namespace reachlab::cli
