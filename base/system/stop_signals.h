#pragma once
#include <atomic>

namespace reachlab {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, with 128 + their number (130, 143, 129): files are replaced in one step
/// and logs only grow, so nothing is lost by that. Unless a StopRequest is waiting for them. SIGHUP that was ignored (nohup) stays so.
void endOnSignals();

/// While one is there, something has to be put in order first (zero force, the trial marked, the log closed): a signal then only raises
/// `asked`. One at a time; controlling thread.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  static const std::atomic<bool>& asked();
  /// All is in order: what is still to be done (the dataset's tables, which can be written again at any time) may take until 0.8 s after
  /// the signal, and the program then ends.
  void allInOrder();
  /// 128 + the number of the signal that came; 0 when none came.
  static int exitCode();
};

}  // namespace reachlab
