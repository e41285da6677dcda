#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/instruments/instrument.h"
#include "sim/record/log/instrument_link.h"

namespace reachlab::devices {

/// Runs instruments beside a run. Ticks go through a queue to one I/O thread. That thread finds the events by the recording's rules, tells
/// each instrument, and notes the delay of each sending behind the tick's clock. An instrument that fails is left out from then on.
std::unique_ptr<record::InstrumentLink> linkInstruments(std::vector<std::unique_ptr<Instrument>> instruments);

/// Opens the requested instruments: `lsl`, `parallel:PATH`, `rts:PATH`, `byte:PATH`. Their keys are `go=N,onset=N,success=N,end=N` (0: no
/// mark), `pulse-ms=N` and `baud=N`. Null when no instrument was requested. Throws FaultError (an unknown name, key or value) or
/// ResourceError (the instrument cannot be opened).
std::unique_ptr<record::InstrumentLink> openInstruments(const std::vector<std::string>& specs);

}  // namespace reachlab::devices
