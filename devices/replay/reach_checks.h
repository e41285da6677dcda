#pragma once
#include "devices/replay/recorded_reach.h"

namespace reachlab::devices {

/// Throws FaultError at this place.
[[noreturn]] void refuse(const FilePlace& place, const std::string& what, const std::string& allowed = {}, const std::string& key = {});
/// The length of `unit` in metres, or the time in seconds. Throws FaultError with `ORIGIN`, the wrong unit and the allowed units.
double metresOf(const std::string& unit, const FilePlace& place, const std::string& key = {});
double secondsOfUnit(const std::string& unit, const FilePlace& place, const std::string& key = {});

/// The samples of a tracking system, some of which are missing. Missing samples at the ends are left off. A gap of up to 0.1 s is left to
/// the spline. Throws FaultError for a longer gap, or when all samples are missing.
class SeenSamples {
 public:
  explicit SeenSamples(std::string file) { reach_.file = std::move(file); }
  void add(double time, const Vec3& position);
  void miss() { missed_ = true; }
  RecordedReach take();

 private:
  RecordedReach reach_;
  bool missed_ = false;  // a sample was missed since the latest seen sample
};

}  // namespace reachlab::devices
