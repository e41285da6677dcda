#pragma once
#include <string>
#include <vector>

#include "sim/haptics/run_sink.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Other instruments of the laboratory that follow a run on the same clock: told what happens, asked what they saw. Ticks come as to any sink
/// and are handed on without waiting; all else is of the controlling thread.
class InstrumentLink : public haptics::RunSink {
 public:
  /// What is kept of them in the run's configuration: their names as they were asked for.
  virtual std::string names() const = 0;
  /// A run begins: `onTick` comes from now on.
  virtual void begin(const RunConfiguration& configuration) = 0;
  /// What was sent and received since the last call (EventKind::Instrument), for the recording.
  virtual std::vector<RecordedEvent> takeEvents() = 0;
  /// What a person must know, a sentence each: an instrument that is gone. Each once.
  virtual std::vector<std::string> takeWarnings() = 0;
};

}  // namespace reachlab::record
