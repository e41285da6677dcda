// What the fuzzer has found interesting goes through the same case at every test run.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "test_paths.h"
#include "tests/fuzz/formula_case.h"

namespace reachlab::constraints {
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

// One case a line, what is not printable as %HH: the new coverage of the fuzzer's runs, cases of up to 120 bytes.
std::string unescaped(const std::string& line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool escape = line[i] == '%' && i + 2 < line.size();
    text += escape ? static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16)) : line[i];
    if (escape) i += 2;
  }
  return text;
}

TEST(FormulaCorpus, WhatTheFuzzerFoundEndsAsItShould) {
  std::ifstream in(REACHLAB_SOURCE_DIR "/tests/fuzz/formula_found.txt");
  int cases = 0;
  for (std::string line; std::getline(in, line); ++cases) {
    const std::string text = unescaped(line);
    EXPECT_NO_THROW(runFormulaCase(reinterpret_cast<const std::uint8_t*>(text.data()), text.size())) << line;
  }
  EXPECT_GE(cases, 800);
}

}  // namespace
}  // namespace reachlab::constraints
