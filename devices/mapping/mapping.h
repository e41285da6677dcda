#pragma once
#include <array>
#include <optional>
#include <string>

#include "base/math/vec3.h"

namespace reachlab::devices {

/// How a device's place becomes the hand's place in the world:  r = offset + s R M r_device,  v = s R M v_device, and back
/// F_device = (R M)^T F: the force is felt as it is computed, only turned, so that with a scale s the device does 1/s of the work.
/// R turns by `rotation` about its own direction, M mirrors x (a task for the right hand done with the left one).
struct Mapping {
  double scale = 1;  // world metres for one of the device, > 0
  Vec3 offset;       // [m] world
  Vec3 rotation;     // [rad] rotation vector
  bool mirrorX = false;
};

/// Rows of R M.
std::array<Vec3, 3> directions(const Mapping& mapping) noexcept;

/// `{"scale": 1, "offset_m": [x, y, z], "rotation_deg": [x, y, z], "mirror_x": false}`; every key may be left out when reading.
/// Throws FaultError naming `origin` and the key.
std::string toJson(const Mapping& mapping);
Mapping mappingFromJson(const std::string& text, const std::string& origin);
Mapping readMapping(const std::string& file);

/// Where a subject's mapping of a kind of device ("phantom") is kept in a dataset: `sourcedata/mappings/sub-03_phantom.json`.
std::string mappingFile(const std::string& data, const std::string& subject, const std::string& device);
/// Throws ResourceError.
void saveMapping(const Mapping& mapping, const std::string& file);

}  // namespace reachlab::devices
