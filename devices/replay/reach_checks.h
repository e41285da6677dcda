#pragma once
#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {

/// Throws FaultError at this place.
[[noreturn]] void refuse(const FilePlace& place, const std::string& what, const std::string& allowed = {}, const std::string& key = {});
/// The length of `unit` in metres, or the time in seconds. Throws FaultError with `ORIGIN`, the wrong unit and the allowed units.
double metresOf(const std::string& unit, const FilePlace& place, const std::string& key = {});
double secondsOfUnit(const std::string& unit, const FilePlace& place, const std::string& key = {});

/// The samples of a reach that were seen, in order of time. The spline bridges a gap of up to longestGap of the
/// median interval. Throws FaultError for a longer gap, for a time that does not increase, or without any
/// sample.
class SeenSamples {
 public:
  explicit SeenSamples(std::string file) { reach_.file = std::move(file); }
  void add(double time, const Vec3& position);
  RecordedReach take();

 private:
  RecordedReach reach_;
};

}  // namespace reachlab::devices
