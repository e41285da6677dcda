// Starts the program of its own name that is compiled for this processor: of the levels that are installed (x86-64-v2, -v3, -v4) the highest
// that the processor has, or the one that REACHLAB_LEVEL names. All levels compute the same bits; a higher one is quicker. Compiled for any
// x86-64 processor itself.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {
namespace fs = std::filesystem;

struct Level {
  const char* name;
  bool isHere;  // the processor has it
};

int fail(const char* program, const std::string& what) {
  std::fprintf(stderr, "error: %s: %s\n", program, what.c_str());
  return 3;  // of a resource that cannot be had
}

}  // namespace

int main(int, char** arguments) {
  __builtin_cpu_init();
  const Level levels[] = {{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
                          {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0},
                          {"x86-64-v2", __builtin_cpu_supports("x86-64-v2") != 0}};
  std::error_code ignored;
  const fs::path own = fs::read_symlink("/proc/self/exe", ignored);
  if (own.empty())
    return fail(REACHLAB_PROGRAM,
                "/proc is not mounted\nhelp: mount it with `mount -t proc proc /proc`, because it tells where this program is installed");
  const fs::path folder = own.parent_path() / REACHLAB_LIBEXEC_FROM_BIN;
  const char* asked = std::getenv("REACHLAB_LEVEL");
  if (asked != nullptr && *asked == '\0') asked = nullptr;
  for (const Level& level : levels) {
    if (asked != nullptr ? std::string(asked) != level.name : !level.isHere) continue;
    if (!level.isHere)
      return fail(REACHLAB_PROGRAM, "REACHLAB_LEVEL is " + std::string(asked) +
                                        ", which this computer's processor does not have\nhelp: leave REACHLAB_LEVEL out");
    const fs::path program = (folder / level.name / REACHLAB_PROGRAM).lexically_normal();
    ::execv(program.c_str(), arguments);
    if (asked != nullptr) return fail(REACHLAB_PROGRAM, program.string() + " cannot be started\nhelp: install all files of Reachlab again");
  }
  if (asked != nullptr)
    return fail(REACHLAB_PROGRAM, "REACHLAB_LEVEL is " + std::string(asked) + "\nhelp: allowed: x86-64-v2, x86-64-v3, x86-64-v4");
  return fail(
      REACHLAB_PROGRAM,
      "no program for this computer's processor is in " + folder.lexically_normal().string() +
          "\nhelp: packaged programs need a processor of level x86-64-v2 (most since 2009). Otherwise build Reachlab here from its source: "
          "packaging/run");
}
