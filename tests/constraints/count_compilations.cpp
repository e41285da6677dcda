#include "tests/constraints/count_compilations.h"

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "constraints/formula/watch_compilations.h"

namespace reachlab::constraints {
namespace {

std::mutex guard;
std::vector<std::string> compiled;

void note(const FormulaText& text) {
  const std::scoped_lock lock(guard);
  compiled.push_back(text.coordinates[0] + " | " + text.coordinates[1] + " | " + text.coordinates[2]);
}

/// The program that does nothing but count says at its end what it has compiled.
struct Told {
  Told() { watchCompilations(note); }
  ~Told() {
    if (std::getenv("REACHLAB_TELL_COMPILATIONS") == nullptr) return;
    for (const std::string& formula : compiled) std::fprintf(stderr, "compiled %s\n", formula.c_str());
  }
} told;

}  // namespace

}  // namespace reachlab::constraints

std::vector<std::string> reachlab::test::takeCompilations() {
  const std::scoped_lock lock(constraints::guard);
  return std::exchange(constraints::compiled, {});
}
