// libFuzzer on the reader of typed formulas and all that follows it:
//   cmake -B build/fuzz -G Ninja -DREACHLAB_FUZZ=ON -DREACHLAB_GUI=OFF -DCMAKE_CXX_COMPILER=clang++-14
//   ninja -C build/fuzz formula_fuzz
//   build/fuzz/tests/fuzz/formula_fuzz -dict=tests/fuzz/formula.dict -max_len=2100 -timeout=25 -max_total_time=640 NEW_CORPUS tests/fuzz/formula_corpus
#include "tests/fuzz/formula_case.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reachlab::constraints::runFormulaCase(data, size);
  return 0;
}
