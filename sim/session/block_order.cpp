#include <algorithm>
#include <numeric>

#include "base/as_number.h"
#include "base/math/seeded.h"
#include "sim/session/plan.h"

namespace reachlab::session {
namespace {

constexpr std::size_t kMaxAllOrders = 4;  // 4! = 24 orders; beyond, nobody has that many subjects

// Subjects that are numbered take the rows in turn, so that the orders are balanced; others are spread by their label.
std::uint64_t rowOf(const std::string& subject) {
  const auto number = asNumber<std::uint64_t>(subject);
  return number && *number > 0 ? *number - 1 : hashOf(subject);
}

// Fisher-Yates with numbers that depend on the seed alone.
template <typename T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[seededBits(seed, i) % i]);
}

std::vector<std::vector<int>> balancedOrders(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::vector<std::vector<int>> rows;
  if (order.size() <= kMaxAllOrders) {
    do rows.push_back(order);
    while (std::next_permutation(order.begin(), order.end()));
    return rows;
  }
  for (int row = 0; row < count; ++row) {  // a cyclic Latin square: every condition once at every place
    rows.emplace_back();
    for (int place = 0; place < count; ++place) rows.back().push_back((row + place) % count);
  }
  return rows;
}

}  // namespace

std::vector<int> blockOrder(const Plan& plan, const std::string& subject, int day) {
  std::vector<int> order;
  std::vector<std::size_t> movable;  // places in `order` of the blocks that change places
  for (std::size_t i = 0; i < plan.blocks.size(); ++i) {
    const PlanBlock& block = plan.blocks[i];
    if (day != 0 && block.day != 0 && block.day != day) continue;
    if (!block.practice) movable.push_back(order.size());
    order.push_back(static_cast<int>(i));
  }
  if (plan.counterbalance == Counterbalance::None || movable.size() < 2) return order;
  std::vector<std::vector<int>> rows = balancedOrders(static_cast<int>(movable.size()));
  shuffle(rows, plan.orderSeed);
  const std::vector<int>& row = rows[rowOf(subject) % rows.size()];
  const std::vector<int> before = order;
  for (std::size_t k = 0; k < movable.size(); ++k) order[movable[k]] = before[movable[static_cast<std::size_t>(row[k])]];
  return order;
}

}  // namespace reachlab::session
