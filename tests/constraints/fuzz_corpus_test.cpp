// What the fuzzer has found interesting goes through the same case at every test run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/fuzz/formula_case.h"

namespace reachlab {
namespace {

TEST(FormulaCorpus, EveryTextBecomesAConstraintOrARefusal) {
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(REACHLAB_SOURCE_DIR "/tests/fuzz/formula_corpus")) {
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NO_THROW(runFormulaCase(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())) << entry.path();
    ++cases;
  }
  EXPECT_GE(cases, 20);
}

}  // namespace
}  // namespace reachlab
