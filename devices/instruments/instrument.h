#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec3.h"
#include "sim/record/configuration/run_configuration.h"

namespace reachlab::devices {

/// Every trial ends with one mark: `Success`, or `End` for every other outcome.
enum class Mark : std::uint8_t { Go, Onset, Success, End };
inline constexpr int kMarkCount = 4;
const char* nameOf(Mark mark);

/// What happened at a tick of the run.
struct Marker {
  Mark mark = Mark::Go;
  int trial = 0;
  std::int64_t ns = 0;  // monotonic clock at the tick
};

struct HandAtTick {
  std::int64_t ns = 0;
  Vec3 position, velocity;  // [m], [m/s]
};

/// What an instrument has to say for the recording. `ns`: monotonic clock when it happened.
struct InstrumentNote {
  std::int64_t ns = 0;
  std::string text;
  double value = 0;
};

/// An instrument beside the haptic device, driven by one I/O thread: every member but the constructor and `name` is that thread's, and may take
/// a while, but not wait for an answer. What cannot be sent throws ResourceError: the instrument is then lost.
class Instrument {
 public:
  virtual ~Instrument() = default;
  const std::string& name() const { return name_; }
  virtual void begin(const record::RunConfiguration&, std::vector<InstrumentNote>&) {}
  /// True when this mark is one that it sends, and it has left this computer's hands.
  virtual bool send(const Marker& marker) = 0;
  virtual void hand(const HandAtTick&) {}
  /// Several thousand times a second: ends pulses, asks the inputs.
  virtual void look(std::int64_t, std::vector<InstrumentNote>&) {}
  /// The run has ended.
  virtual void end(std::vector<InstrumentNote>&) {}

 protected:
  explicit Instrument(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

}  // namespace reachlab::devices
