#include <gtest/gtest.h>
#include <malloc.h>

#include "analysis/analysis.h"
#include "tests/analysis/synthetic.h"

namespace reachlab::analysis {
namespace {

// What this program holds on the heap [bytes].
double held() {
  const struct mallinfo2 heap = ::mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

// One person's ten trials, recorded again and again.
double heldBy(std::size_t trials, const AnalysisInput& person) {
  const double before = held();
  AnalysisBuilder builder(AnalysisOptions{});
  for (std::size_t i = 0; i < trials; ++i) {
    TrialData trial = person.trials[i % person.trials.size()];
    trial.key.trial = static_cast<int>(i) + 1;
    builder.add(std::move(trial), 0);
  }
  return held() - before;
}

// 100,000 trials were 3.4 GB when each was kept with its signals, about 35 kB.
TEST(StudyMemory, IsWhatIsSaidOfATrialAndNotItsSignals) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer keeps a heap of its own";
#endif
  const AnalysisInput person = simulatedTrials({{"moderate", compiledChain(1.35)}}, predict::Criterion::MinHandJerk, 0, 1, 1, 10, 1);
  const double few = heldBy(200, person), many = heldBy(1000, person);
  const double bytesATrial = (many - few) / 800;
  EXPECT_GT(bytesATrial, sizeof(AnalyzedTrial) / 2.0) << "something is kept, or nothing was measured";
  EXPECT_LT(bytesATrial, 2000);
}

}  // namespace
}  // namespace reachlab::analysis
