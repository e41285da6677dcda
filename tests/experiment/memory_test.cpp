#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <new>

#include "base/system/error_report.h"
#include "constraints/catalogue/definition.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"

namespace {
thread_local long allocationsLeft = -1;  // until one fails, and no more than one; below zero: none does
}

[[gnu::noinline]] void* operator new(std::size_t size) {
  if (allocationsLeft >= 0 && allocationsLeft-- == 0) throw std::bad_alloc();
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* place) noexcept { std::free(place); }
[[gnu::noinline]] void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace reachlab::experiment {
namespace {

/// Each allocation of `write` fails once, in a separate process. A library that cannot go on ends the program with a message, and never by a signal.
template <class Write>
void expectAnEndInWords(const Write& write) {
  bool failed = true;
  for (long enough = 0; failed && enough < 100'000; ++enough) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      endOnUncaught();
      std::freopen("/dev/null", "w", stderr);
      allocationsLeft = enough;
      try {
        write();
      } catch (const std::bad_alloc&) {
        ::_exit(3);
      }
      ::_exit(allocationsLeft < 0 ? 3 : 0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << "allocation " << enough << ": signal " << WTERMSIG(status);
    failed = WEXITSTATUS(status) != 0;
    ASSERT_TRUE(!failed || WEXITSTATUS(status) == 3) << "allocation " << enough << ": exit " << WEXITSTATUS(status);
  }
  EXPECT_FALSE(failed);
}

TEST(Memory, ThatFailsWhileAnExperimentIsWrittenEndsInWords) {
  for (const char* name : {"dingwell", "torus"}) {
    const Experiment experiment = openExperiment(name).experiment();
    expectAnEndInWords([&] { toJson(experiment); });
  }
}

TEST(Memory, ThatFailsWhileADefinitionIsWrittenEndsInWords) {
  const constraints::Definition surface = constraints::findDefinition("torus", "constraint");
  expectAnEndInWords([&] { constraints::toJson(surface); });
}

}  // namespace
}  // namespace reachlab::experiment
