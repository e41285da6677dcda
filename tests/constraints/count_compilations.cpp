#include "tests/constraints/count_compilations.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <utility>

#include "constraints/formula/formula.h"

#define REACHLAB_COMPILE_FORMULA                                                    \
  "_ZN8reachlab11constraints14compileFormulaERKNS0_11FormulaTextERKNSt7__cxx1112ba" \
  "sic_stringIcSt11char_traitsIcESaIcEEE"

namespace reachlab::constraints {

std::shared_ptr<const CompiledFormula> reallyCompile(const FormulaText& text,
                                                     const std::string& key) asm("__real_" REACHLAB_COMPILE_FORMULA);

namespace {

std::mutex guard;
std::vector<std::string> compiled;

/// The program that does nothing but count says at its end what it has compiled.
struct Told {
  ~Told() {
    if (std::getenv("REACHLAB_TELL_COMPILATIONS") == nullptr) return;
    for (const std::string& formula : compiled) std::fprintf(stderr, "compiled %s\n", formula.c_str());
  }
} told;

}  // namespace

std::shared_ptr<const CompiledFormula> countAndCompile(const FormulaText& text,
                                                       const std::string& key) asm("__wrap_" REACHLAB_COMPILE_FORMULA);

std::shared_ptr<const CompiledFormula> countAndCompile(const FormulaText& text, const std::string& key) {
  {
    const std::scoped_lock lock(guard);
    compiled.push_back(text.coordinates[0] + " | " + text.coordinates[1] + " | " + text.coordinates[2]);
  }
  return reallyCompile(text, key);
}

}  // namespace reachlab::constraints

std::vector<std::string> reachlab::test::takeCompilations() {
  const std::scoped_lock lock(constraints::guard);
  return std::exchange(constraints::compiled, {});
}
