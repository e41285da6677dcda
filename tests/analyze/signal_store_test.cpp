#include "sim/analyze/signal_store.h"

#include <gtest/gtest.h>

namespace reachlab::analyze {
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

}  // namespace
}  // namespace reachlab::analyze
