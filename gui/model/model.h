#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec3.h"

/// Scenes from files as plain data, independent of any graphics library and checked, so that no library can crash on them.
namespace reachlab::gui::model {

/// Triangles of one colour. [m]
struct ModelPart {
  std::string name;  // "hand", "mass1", …: stands for it, its origin there; empty: scenery
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::array<double, 3> colour{0.8, 0.8, 0.8};  // [0, 1] red, green, blue
  double opacity = 1;
};

struct Model {
  std::vector<ModelPart> parts;
  std::size_t triangleCount() const;
};

inline constexpr std::size_t kMostTriangles = 500'000;
inline constexpr std::uintmax_t kMostBytes = 64'000'000;

/// "hand" or "mass7": a part that moves in a scene.
inline bool isMoving(const std::string& name) {
  return name == "hand" || (name.size() > 4 && name.size() < 8 && name.starts_with("mass") && name[4] != '0' &&
                            name.find_first_not_of("0123456789", 4) == std::string::npos);
}

/// Throws FaultError for a part that cannot be drawn: a corner without a point, a number that is not finite, or too much data.
void check(const Model& model, const std::string& file);

/// Called now and then with the finished share [0, 1], or NaN if it is not known. It throws to stop the work.
using Watch = std::function<void(double share)>;

/// Reads a scene in VRML 2.0 (ISO/IEC 14772): groups, transforms, DEF and USE, boxes, balls, cylinders, cones and faces with a material.
/// Lights, views and scripts of the file are ignored. Prototypes and inlined files are refused. A node with a name of isMoving() is a part
/// of that name. It keeps the frame of its node without its shift, so that its origin follows the mass. Throws FaultError with position,
/// found text and allowed text.
Model readVrml(std::string_view text, const std::string& file, const Watch& watch = {});

/// Reads a scene file by its ending: wrl (VRML 2.0), gltf or glb (read by a separate process). Throws FaultError, ResourceError.
Model readModel(const std::string& file, const Watch& watch = {});

}  // namespace reachlab::gui::model
