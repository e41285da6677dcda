#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec3.h"
#include "sim/record/configuration/run_configuration.h"

namespace reachlab::devices {

/// Every trial ends with one mark: `Success`, or `End` for every other outcome.
enum class Mark : std::uint8_t { Go, Onset, Success, End };
inline constexpr std::array kMarkNames{"go", "onset", "success", "end"};
inline const char* nameOf(Mark mark) { return kMarkNames[static_cast<std::size_t>(mark)]; }

/// The event at a tick of the run.
struct Marker {
  Mark mark = Mark::Go;
  int trial = 0;
  std::int64_t ns = 0;  // monotonic clock at the tick
};

struct HandAtTick {
  std::int64_t ns = 0;
  Vec3 position, velocity;  // [m], [m/s]
};

/// A message of an instrument for the recording. `ns`: time of the event on the monotonic clock.
struct InstrumentNote {
  std::int64_t ns = 0;
  std::string text;
  double value = 0;
};

/// An instrument beside the haptic device, driven by one I/O thread. That thread calls every member except the constructor and `name`. A
/// call may take a while, but must not wait for an answer. A send that fails throws ResourceError, and the instrument then counts as lost.
class Instrument {
 public:
  virtual ~Instrument() = default;
  const std::string& name() const { return name_; }
  virtual void begin(const record::RunConfiguration&, std::vector<InstrumentNote>&) {}
  /// True when the instrument sends this mark and the mark has left the computer.
  virtual bool send(const Marker& marker) = 0;
  virtual void hand(const HandAtTick&) {}
  /// Ends pulses and reads the inputs. Called several thousand times per second.
  virtual void look(std::int64_t, std::vector<InstrumentNote>&) {}
  /// The run has ended.
  virtual void end(std::vector<InstrumentNote>&) {}

 protected:
  explicit Instrument(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

}  // namespace reachlab::devices
