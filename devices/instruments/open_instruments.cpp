#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/device_options.h"
#include "base/fault.h"
#include "devices/instruments/instruments.h"
#include "devices/instruments/lab_streaming.h"
#include "devices/instruments/trigger_lines.h"

namespace reachlab::devices {
namespace {

constexpr const char* kKnown = "lsl, parallel:PATH, rts:PATH, byte:PATH";

std::unique_ptr<Instrument> open(const std::string& spec) {
  const std::size_t end = std::min({spec.find(':'), spec.find(','), spec.size()});
  const std::string kind = spec.substr(0, end);
  DeviceOptions options(end < spec.size() ? spec.substr(spec[end] == ':' ? end + 1 : end) : "", "instrument " + kind);
  if (kind == "lsl") {
    options.done();
    return openLabStreaming(spec);
  }
  if (kind != "parallel" && kind != "rts" && kind != "byte")
    throw FaultError(Fault{"instrument", "is " + spec + ", which is unknown", kKnown});
  TriggerLine line{.name = spec, .path = options.plain()};
  if (line.path.empty()) throw FaultError(Fault{"instrument", kind + ": its port is missing", kind + ":/dev/…"});
  for (std::size_t i = 0; i < kMarkNames.size(); ++i) line.codes[i] = options.count(kMarkNames[i], line.codes[i], 0, 255);
  if (kind == "byte") line.baud = options.count("baud", line.baud, 1, 10000000);
  else line.pulse = 1e-3 * options.number("pulse-ms", 1e3 * line.pulse, 1, 1000);
  options.done();
  return kind == "byte" ? openByteLine(line) : kind == "rts" ? openSerialLines(line) : openParallelPort(line);
}

}  // namespace

std::unique_ptr<record::InstrumentLink> openInstruments(const std::vector<std::string>& specs) {
  if (specs.empty()) return nullptr;
  std::vector<std::unique_ptr<Instrument>> instruments;
  for (const std::string& spec : specs) instruments.push_back(open(spec));
  return linkInstruments(std::move(instruments));
}

}  // namespace reachlab::devices
