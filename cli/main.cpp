#include "base/system/error_report.h"
#include "base/system/os.h"
#include "base/system/processor_level.h"
#include "base/system/stop_signals.h"
#include "cli/commands/commands.h"
#include "cli/terminal/standard_streams.h"

int main(int argc, char** argv) {
  reachlab::requireProcessorLevel();
  reachlab::endOnUncaught();
  reachlab::os::keepFreedMemory();
  reachlab::os::holdStandardDescriptors();
  reachlab::cli::guardStandardStreams();
  reachlab::endOnSignals();
  return reachlab::cli::finishStandardOutput(reachlab::cli::runReach(argc, argv));
}
