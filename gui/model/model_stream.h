#pragma once
#include <cstdio>
#include <cstring>
#include <string_view>

#include "gui/model/model.h"

/// Format of a model between two processes of one machine. It begins with "reachlab-model 1". Each part has a line `part NAME RED GREEN
/// BLUE OPACITY POINTS TRIANGLES` (NAME "-" means no name). Its points follow as doubles and its corners as 32-bit numbers.
namespace reachlab::gui::model {

inline constexpr std::string_view kStreamHead = "reachlab-model 1\n";

inline void write(const Model& model, std::FILE* out) {
  std::fwrite(kStreamHead.data(), 1, kStreamHead.size(), out);
  for (const ModelPart& part : model.parts) {
    std::fprintf(out, "part %s %.17g %.17g %.17g %.17g %zu %zu\n", part.name.empty() ? "-" : part.name.c_str(), part.colour[0],
                 part.colour[1], part.colour[2], part.opacity, part.points.size(), part.triangles.size());
    std::fwrite(part.points.data(), sizeof(Vec3), part.points.size(), out);
    std::fwrite(part.triangles.data(), sizeof part.triangles[0], part.triangles.size(), out);
  }
}
static_assert(sizeof(Vec3) == 24 && sizeof(std::array<std::uint32_t, 3>) == 12);

/// Throws FaultError where it is no such stream. Trusts nothing in it.
Model readStream(std::string_view bytes, const std::string& file);

}  // namespace reachlab::gui::model
