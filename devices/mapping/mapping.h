#pragma once
#include <array>
#include <optional>
#include <string>

#include "base/math/vec3.h"

namespace reachlab::devices {

/// How a position of the device becomes the position of the hand in the world: r = offset + s R M r_device and v = s R M v_device. The
/// force goes back as F_device = (R M)^T F: it is turned, not scaled. So with a scale s the device does 1/s of the work. R turns by
/// `rotation` about its direction, and M mirrors x (a right-handed task done with the left hand).
struct Mapping {
  double scale = 1;  // metres in the world per metre of the device, > 0
  Vec3 offset;       // [m] world
  Vec3 rotation;     // [rad] rotation vector
  bool mirrorX = false;
};

/// Rows of R M.
std::array<Vec3, 3> directions(const Mapping& mapping) noexcept;

/// `{"scale": 1, "offset_m": [x, y, z], "rotation_deg": [x, y, z], "mirror_x": false}`. The reader accepts a file without any of these
/// keys. Throws FaultError, which names `origin` and the key.
std::string toJson(const Mapping& mapping);
Mapping mappingFromJson(const std::string& text, const std::string& origin);
Mapping readMapping(const std::string& file);

/// The same as options of a device: "scale=1.5,mirror=x". At least one of them.
std::string optionsOf(const Mapping& mapping);

/// The path in a dataset of a subject's mapping for a kind of device ("phantom"): `sourcedata/mappings/sub-03_phantom.json`.
std::string mappingFile(const std::string& data, const std::string& subject, const std::string& device);
/// Throws ResourceError.
void saveMapping(const Mapping& mapping, const std::string& file);

}  // namespace reachlab::devices
