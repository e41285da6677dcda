#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace reachlab {

/// A label with its description and unit, as C3D stores them side by side.
struct C3dLabel {
  std::string name;
  std::string description = {};
  std::string unit = {};  // of an analog channel; that of the points is one for all
};

struct C3dEvent {
  std::string label;
  double time = 0;  // [s] since the first frame
};

/// A C3D file (biomechanics' common format, c3d.org): points in space and analog channels at equal times. A written file has one analog
/// sample per frame. A read file may have any number. Plain value.
struct C3dFile {
  double rate = 100;      // [1/s] frames
  std::string pointUnit;  // "mm", "m"
  std::vector<C3dLabel> points, analogs;
  std::vector<C3dEvent> events;
  std::vector<std::pair<std::string, std::string>> notes;  // texts by upper-case name, written as the group REACHLAB; not read

  std::size_t frames = 0;
  std::vector<float> places;   // frames x points x 3, in pointUnit
  std::vector<char> seen;      // frames x points: 0 where the point was not seen
  std::vector<float> signals;  // frames x analogs, written only
};

/// The file's bytes: Intel floats, with parameters as in c3d.org's guide. Throws FaultError beyond the limits of the format (65535 points
/// or channels, 2^31 frames).
std::string c3dBytes(const C3dFile& file);

/// Reads the points and the events: floats or scaled integers of Intel, MIPS and DEC processors. Throws FaultError
/// `FILE: what; allowed: …` on bytes that are no such file.
C3dFile readC3d(std::string_view bytes, const std::string& origin);

}  // namespace reachlab
