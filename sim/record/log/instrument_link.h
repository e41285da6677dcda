#pragma once
#include <string>
#include <vector>

#include "sim/haptics/run_sink.h"
#include "sim/record/configuration/run_configuration.h"
#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// Other instruments of the laboratory that follow a run on the same clock. They get the run's events and return theirs. Ticks come as to
/// any sink and are handed on without waiting. All other members belong to the controlling thread.
class InstrumentLink : public haptics::RunSink {
 public:
  /// Their names as they were requested, for the run's configuration.
  virtual std::string names() const = 0;
  /// A run begins: `onTick` comes from now on.
  virtual void begin(const RunConfiguration& configuration) = 0;
  /// The events sent and received since the last call (EventKind::Instrument), for the recording.
  virtual std::vector<RecordedEvent> takeEvents() = 0;
  /// Warnings for a person, one sentence each, such as a lost instrument. Each comes once.
  virtual std::vector<std::string> takeWarnings() = 0;
};

}  // namespace reachlab::record
