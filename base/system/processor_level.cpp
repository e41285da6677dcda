// Compiled for the oldest processor of its family, whatever the rest of the program is compiled for (base/CMakeLists.txt).
#include "base/system/processor_level.h"

#include <unistd.h>

#include <cstring>

namespace reachlab {
namespace {

constexpr int kExitCode = 3;  // of a resource that cannot be had

#if defined(__x86_64__) && REACHLAB_LEVEL_NUMBER > 1
bool isThere() noexcept {
  __builtin_cpu_init();
#if REACHLAB_LEVEL_NUMBER == 2
  return __builtin_cpu_supports("x86-64-v2") != 0;
#elif REACHLAB_LEVEL_NUMBER == 3
  return __builtin_cpu_supports("x86-64-v3") != 0;
#else
  return __builtin_cpu_supports("x86-64-v4") != 0;
#endif
}
#else
bool isThere() noexcept { return true; }
#endif

void say(const char* text) noexcept { (void)!::write(STDERR_FILENO, text, std::strlen(text)); }

// Before the constructors of the program's own objects, which are compiled for the newer processor.
[[gnu::constructor(101)]] void refuseOlderProcessors() noexcept { requireProcessorLevel(); }

}  // namespace

const char* processorLevel() noexcept { return REACHLAB_LEVEL_NAME; }

void requireProcessorLevel() noexcept {
  if (isThere()) return;
  say("error: this program is compiled for processors of level " REACHLAB_LEVEL_NAME
      ", and this computer's processor is older\nhelp: build Reachlab here from its source: packaging/run\n");
  ::_exit(kExitCode);
}

}  // namespace reachlab
