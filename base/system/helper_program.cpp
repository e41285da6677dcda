#include "base/system/helper_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <vector>

#include "base/error.h"

namespace reachlab {
namespace fs = std::filesystem;

std::string findHelperProgram(const std::string& name, const std::string& program, const std::string& what) {
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
  std::vector<fs::path> places{own / name, own / REACHLAB_LIBEXEC_FROM_BIN / name};
  for (const fs::path& tree : {own.parent_path(), own.parent_path().parent_path()})  // of a program, of a test
    for (const char* folder : {"cli", "gui"}) places.push_back(tree / folder / name);
  for (const fs::path& place : places)
    if (access(place.c_str(), X_OK) == 0) return place.string();
  throw ResourceError(fmt::format("{}: {}, {}, is neither {} nor {}; install Reachlab whole, or build the target {}", program, name, what,
                                  places[0].lexically_normal().string(), places[1].lexically_normal().string(), name));
}

}  // namespace reachlab
