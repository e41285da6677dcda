#pragma once
#include <atomic>

namespace reachlab {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, with 128 + their number (130, 143, 129). Nothing is lost by that,
/// because files are replaced in one step and logs only grow. A waiting StopRequest comes first. SIGHUP stays ignored if it was ignored
/// (nohup).
void endOnSignals();

/// While a StopRequest exists, the program has to finish some work before it ends (zero force, the trial marked, the log closed). A signal
/// then only raises `asked`. One request at a time. Controlling thread.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  static const std::atomic<bool>& asked();
  /// The necessary work is done. The rest may take until 0.8 s after the signal, and the program then ends. The rest is the dataset's
  /// tables, which can be written again at any time.
  void allInOrder();
  /// 128 + the number of the signal that came, or 0 if no signal came.
  static int exitCode();
};

}  // namespace reachlab
