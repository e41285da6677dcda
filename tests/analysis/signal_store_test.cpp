#include "analysis/trials/signal_store.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "base/error.h"
#include "tests/refusal.h"

namespace reachlab::analysis {
namespace {

// Whatever is put aside comes back, in any order, however much of it memory holds.
TEST(SignalStore, GivesBackEveryRowFromMemoryAndFromTheFile) {
  for (const std::size_t most : {0u, 1u, 50u, 1000u, 100'000u}) {
    SignalStore store(most);
    std::vector<std::vector<double>> written;
    std::vector<SignalStore::Row> rows;
    for (std::size_t row = 0; row < 60; ++row) {
      std::vector<double> values(row % 7 == 3 ? 0 : 1 + row * 13 % 40);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1000.0 * static_cast<double>(row) + static_cast<double>(i);
      rows.push_back(store.put(values));
      written.push_back(values);
      EXPECT_EQ(store.get(rows[row / 2]), written[row / 2]) << "read between writes, of " << most;
    }
    for (std::size_t row = rows.size(); row-- > 0;) EXPECT_EQ(store.get(rows[row]), written[row]) << row << " of " << most;
  }
}

// As on a full disk: no file may be larger than a megabyte.
TEST(SignalStore, SaysWhenTheDiskTakesNoMore) {
  struct rlimit before {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit small { 1 << 20, before.rlim_max };
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  SignalStore store(10);
  const std::string refusal = refusalOf<ResourceError>([&] { store.put(std::vector<double>(1 << 19, 1.0)); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old);
  EXPECT_NE(refusal.find("the temporary file of the analysis cannot be written: File too large"), std::string::npos) << refusal;
}

}  // namespace
}  // namespace reachlab::analysis
