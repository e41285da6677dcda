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

TriggerCodes takeCodes(DeviceOptions& options) {
  TriggerCodes codes;
  for (const Mark mark : {Mark::Go, Mark::Onset, Mark::Success, Mark::End}) {
    int& code = codes.code[static_cast<std::size_t>(mark)];
    code = static_cast<int>(std::lround(options.number(nameOf(mark), code, 0, 255)));
  }
  return codes;
}

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
  const std::string path = options.plain();
  if (path.empty()) throw FaultError(Fault{"instrument", kind + ": its port is missing", kind + ":/dev/…"});
  TriggerCodes codes = takeCodes(options);
  if (kind == "byte") {
    const int baud = static_cast<int>(options.number("baud", 115200, 1, 1e7));
    options.done();
    return openByteLine(spec, path, codes, baud);
  }
  codes.pulse = 1e-3 * options.number("pulse-ms", 1e3 * codes.pulse, 1, 1000);
  options.done();
  return kind == "rts" ? openSerialLines(spec, path, codes) : openParallelPort(spec, path, codes);
}

}  // namespace

std::unique_ptr<record::InstrumentLink> openInstruments(const std::vector<std::string>& specs) {
  if (specs.empty()) return nullptr;
  std::vector<std::unique_ptr<Instrument>> instruments;
  for (const std::string& spec : specs) instruments.push_back(open(spec));
  return linkInstruments(std::move(instruments));
}

}  // namespace reachlab::devices
