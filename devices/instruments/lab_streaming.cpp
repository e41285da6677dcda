#include "devices/instruments/lab_streaming.h"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "base/error.h"
#include "base/system/os.h"
#include "base/ticks.h"
#include "devices/vendor/shared_library.h"
#include "sim/record/export/run_tables.h"

namespace reachlab::devices {
namespace {

// The part of liblsl's C interface (lsl_c.h, version 1.13 on) that is used.
using Info = void*;
using Outlet = void*;
using Xml = void*;
constexpr int kDouble = 2, kText = 3;  // lsl_channel_format_t
constexpr double kIrregular = 0;       // LSL_IRREGULAR_RATE
constexpr int kBufferedSeconds = 360;  // liblsl's own default
constexpr int kPushThrough = 1;

struct Api {
  SharedLibrary library{{"liblsl.so.2", "liblsl.so", "liblsl64.so", "liblsl.so.1"}};
  Info (*createInfo)(const char*, const char*, std::int32_t, double, int, const char*) = library.require("lsl_create_streaminfo");
  void (*destroyInfo)(Info) = library.require("lsl_destroy_streaminfo");
  Xml (*describe)(Info) = library.require("lsl_get_desc");
  Xml (*appendChild)(Xml, const char*) = library.require("lsl_append_child");
  Xml (*appendValue)(Xml, const char*, const char*) = library.require("lsl_append_child_value");
  Outlet (*createOutlet)(Info, std::int32_t, std::int32_t) = library.require("lsl_create_outlet");
  void (*destroyOutlet)(Outlet) = library.require("lsl_destroy_outlet");
  std::int32_t (*pushNumbers)(Outlet, const double*, double, std::int32_t) = library.require("lsl_push_sample_dtp");
  std::int32_t (*pushTexts)(Outlet, const char**, double, std::int32_t) = library.require("lsl_push_sample_strtp");
  double (*clock)() = library.require("lsl_local_clock");
};

// One stream; both of its handles are given back.
class Stream {
 public:
  Stream(const Api& api, const char* name, const char* type, const std::vector<std::pair<const char*, const char*>>& channels, double rate,
         int format, const std::string& source, const std::string& clock)
      : api_(api) {
    info_ = api.createInfo(name, type, static_cast<std::int32_t>(channels.size()), rate, format, (source + name).c_str());
    if (info_ == nullptr) throw ResourceError(fmt::format("liblsl: makes no stream {}", name));
    const Xml description = api.describe(info_);
    api.appendValue(description, "clock", clock.c_str());
    const Xml list = api.appendChild(description, "channels");
    for (const auto& [label, unit] : channels) {
      const Xml channel = api.appendChild(list, "channel");
      api.appendValue(channel, "label", label);
      api.appendValue(channel, "unit", unit);
    }
    outlet_ = api.createOutlet(info_, 0, kBufferedSeconds);
    if (outlet_ == nullptr) {
      api.destroyInfo(info_);
      throw ResourceError(fmt::format("liblsl: makes no outlet {}", name));
    }
  }
  ~Stream() {
    api_.destroyOutlet(outlet_);
    api_.destroyInfo(info_);
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  Outlet outlet() const { return outlet_; }

 private:
  const Api& api_;
  Info info_ = nullptr;
  Outlet outlet_ = nullptr;
};

class LabStreaming final : public Instrument {
 public:
  explicit LabStreaming(const std::string& name) : Instrument(name) {}

  void begin(const record::RunConfiguration& configuration, std::vector<InstrumentNote>& notes) override {
    hand_.reset();
    markers_.reset();
    measureClock(notes);
    const std::string clock =
        record::clockStatement(configuration) +
        fmt::format(" This stream's times are the ticks' by the monotonic clock, shifted by {:.9f} s into LSL's clock.", offset_);
    const std::string source = fmt::format("sub-{}_ses-{}_run-{}_", configuration.subject, configuration.session, configuration.run);
    markers_ = std::make_unique<Stream>(api_, "reachlab-markers", "Markers",
                                        std::vector<std::pair<const char*, const char*>>{{"marker", ""}}, kIrregular, kText, source, clock);
    const std::vector<std::pair<const char*, const char*>> channels{{"hand_x", "m"},    {"hand_y", "m"},    {"hand_z", "m"},
                                                                    {"hand_vx", "m/s"}, {"hand_vy", "m/s"}, {"hand_vz", "m/s"}};
    hand_ = std::make_unique<Stream>(api_, "reachlab-hand", "MoCap", channels, kTicksPerSecond, kDouble, source, clock);
  }

  bool send(const Marker& marker) override {
    const std::string text = fmt::format("{} {}", nameOf(marker.mark), marker.trial);
    const char* data = text.c_str();
    if (api_.pushTexts(markers_->outlet(), &data, timeOf(marker.ns), kPushThrough) != 0)
      throw ResourceError("liblsl: takes no marker any more");
    return true;
  }

  void hand(const HandAtTick& hand) override {
    const std::array<double, 6> values{hand.position.x, hand.position.y, hand.position.z,
                                       hand.velocity.x, hand.velocity.y, hand.velocity.z};
    if (api_.pushNumbers(hand_->outlet(), values.data(), timeOf(hand.ns), kPushThrough) != 0)
      throw ResourceError("liblsl: takes no sample any more");
  }

  void end(std::vector<InstrumentNote>& notes) override { measureClock(notes); }

 private:
  double timeOf(std::int64_t ns) const { return static_cast<double>(ns) * 1e-9 + offset_; }

  // LSL's clock less the monotonic one, by the tightest of several pairs of readings. The streams keep the offset that they began with.
  void measureClock(std::vector<InstrumentNote>& notes) {
    std::int64_t tightest = std::numeric_limits<std::int64_t>::max();
    double offset = 0;
    for (int look = 0; look < 20; ++look) {
      const std::int64_t before = os::now();
      const double lsl = api_.clock();
      const std::int64_t after = os::now();
      if (after - before >= tightest) continue;
      tightest = after - before;
      offset = lsl - 0.5e-9 * static_cast<double>(before + after);
    }
    if (!markers_) offset_ = offset;
    notes.push_back({os::now(), "clock less CLOCK_MONOTONIC [s]", offset});
  }

  Api api_;
  double offset_ = 0;  // [s]
  std::unique_ptr<Stream> markers_, hand_;
};

}  // namespace

std::unique_ptr<Instrument> openLabStreaming(const std::string& name) { return std::make_unique<LabStreaming>(name); }

}  // namespace reachlab::devices
