#pragma once
#include <memory>
#include <string>
#include <vector>

#include "devices/instruments/instrument.h"
#include "sim/record/log/instrument_link.h"

namespace reachlab::devices {

/// Puts instruments beside a run: ticks go through a queue to one I/O thread, which finds what happened by the recording's own rules, tells each
/// instrument, and notes with each sending how long after the tick's clock it was done. An instrument that fails is left out from then on.
std::unique_ptr<record::InstrumentLink> linkInstruments(std::vector<std::unique_ptr<Instrument>> instruments);

/// Opens what was asked for: `lsl`, `parallel:PATH`, `rts:PATH`, `byte:PATH`, with `go=N,onset=N,success=N,end=N` (0: nothing), `pulse-ms=N`, `baud=N`.
/// Null when nothing was. Throws FaultError (an unknown name, key or value), ResourceError (it cannot be had).
std::unique_ptr<record::InstrumentLink> openInstruments(const std::vector<std::string>& specs);

}  // namespace reachlab::devices
