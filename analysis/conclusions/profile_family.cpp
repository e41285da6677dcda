#include "analysis/conclusions/profile_family.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/lanes.h"

namespace reachlab::analysis {
namespace {

constexpr std::size_t kCellsAtOnce = 4;  // numbers side by side
using FourNumbers = Lanes<kCellsAtOnce>;
constexpr int kNodes = 20000;  // durations that may ever be asked for: 0 … kNodes * spacing

/// Slope at sample i by central differences of fourth order; what lies beyond the ends counts as 0.
double slopeAt(const std::vector<double>& f, std::ptrdiff_t i) {
  const auto n = static_cast<std::ptrdiff_t>(f.size());
  const auto at = [&](std::ptrdiff_t k) { return k >= 0 && k < n ? f[static_cast<std::size_t>(k)] : 0.0; };
  return (8 * (at(i + 1) - at(i - 1)) - (at(i + 2) - at(i - 2))) / 12;
}

}  // namespace

double Profile::at(double s) const {
  const double x = (s - first) / step;
  const auto n = static_cast<std::ptrdiff_t>(value.size());
  if (!(x >= 0) || x > static_cast<double>(n - 1)) return 0;
  const std::ptrdiff_t i = std::min(static_cast<std::ptrdiff_t>(x), n - 2);
  const double d = x - static_cast<double>(i);
  const double f0 = value[static_cast<std::size_t>(i)], f1 = value[static_cast<std::size_t>(i + 1)];
  const double m0 = slopeAt(value, i), m1 = slopeAt(value, i + 1);
  return f0 + d * (m0 + d * (3 * (f1 - f0) - 2 * m0 - m1 + d * (2 * (f0 - f1) + m0 + m1)));
}

ProfileFamily::ProfileFamily(Sampler sampler, const RecordingFilter& filter, const Grid& grid)
    : sampler_(std::move(sampler)), filter_(filter), grid_(grid), published_(new std::atomic<const Node*>[kNodes]), count_(kNodes) {
  for (int i = 0; i < count_; ++i) published_[static_cast<std::size_t>(i)].store(nullptr, std::memory_order_relaxed);
  margin_ = marginAt(grid.shortest);
}

ProfileFamily::Sampler ProfileFamily::sameFor(std::function<double(double s)> phiOf) {
  return [phiOf = std::move(phiOf)](double, std::span<double> phi) {
    for (std::size_t i = 0; i < phi.size(); ++i) phi[i] = phiOf(static_cast<double>(i) / static_cast<double>(phi.size() - 1));
    return true;
  };
}

std::size_t ProfileFamily::marginAt(double duration) const {
  return static_cast<std::size_t>(std::ceil(filter_.reach() / duration * static_cast<double>(grid_.parts))) + 2;
}

ProfileFamily::Node ProfileFamily::exactAt(double duration) const {
  Node fresh;
  std::vector<double> phi(grid_.parts + 1);
  fresh.possible = sampler_(duration, phi);
  if (fresh.possible) fresh.value = filter_.apply(phi, duration, margin_);
  return fresh;
}

double ProfileFamily::errorAt(double duration) const {
  Profile between;
  const Node exact = exactAt(duration);
  if (!exact.possible || !at(duration, between)) return 1;
  double peak = 0, apart = 0;
  const std::size_t skipped = margin_ - marginAt(duration);  // where the filter does not reach
  for (std::size_t i = 0; i < between.value.size(); ++i) {
    peak = std::max(peak, std::abs(exact.value[i + skipped]));
    apart = std::max(apart, std::abs(exact.value[i + skipped] - between.value[i]));
  }
  return peak > 0 ? apart / peak : 1;
}

const ProfileFamily::Node& ProfileFamily::node(int index) const {
  std::atomic<const Node*>& place = published_[static_cast<std::size_t>(index)];
  if (const Node* known = place.load(std::memory_order_acquire)) return *known;
  auto fresh = std::make_unique<Node>(exactAt(index * grid_.spacing));
  const std::lock_guard lock(mutex_);
  if (const Node* known = place.load(std::memory_order_acquire)) return *known;  // another thread was faster
  nodes_.push_back(std::move(fresh));
  place.store(nodes_.back().get(), std::memory_order_release);
  return *nodes_.back();
}

bool ProfileFamily::at(double duration, Profile& out) const {
  if (!(duration >= grid_.shortest)) return false;
  const double x = duration / grid_.spacing;
  const int first = std::max(1, static_cast<int>(x) - kPoints / 2 + 1);
  if (!(x < count_ - kPoints)) return false;
  std::array<const double*, kPoints> values{};
  for (int j = 0; j < kPoints; ++j) {
    const Node& n = node(first + j);
    if (!n.possible) return false;
    values[static_cast<std::size_t>(j)] = n.value.data();
  }
  // Lagrange's weights and their derivatives by x.
  std::array<double, kPoints> w{}, dw{};
  for (int j = 0; j < kPoints; ++j) {
    double denominator = 1, product = 1, derivative = 0;
    for (int k = 0; k < kPoints; ++k) {
      if (k == j) continue;
      denominator *= j - k;
      derivative = derivative * (x - first - k) + product;
      product *= x - first - k;
    }
    w[static_cast<std::size_t>(j)] = product / denominator;
    dw[static_cast<std::size_t>(j)] = derivative / denominator * x;  // d/d ln T = T d/dT = x d/dx
  }
  const std::size_t margin = marginAt(duration), size = grid_.parts + 1 + 2 * margin;
  out.step = 1 / static_cast<double>(grid_.parts);
  out.first = -static_cast<double>(margin) * out.step;
  out.value.resize(size);
  out.change.resize(size);
  // One pass over the rows for both sums.
  const auto add = [&](std::size_t i, auto load, auto store) {
    auto row = load(values[0] + (margin_ - margin) + i);
    auto value = w[0] * row, change = dw[0] * row;
    for (std::size_t j = 1; j < values.size(); ++j)
      row = load(values[j] + (margin_ - margin) + i), value += w[j] * row, change += dw[j] * row;
    store(value, &out.value[i]), store(change, &out.change[i]);
  };
  std::size_t i = 0;
  for (; i + kCellsAtOnce <= size; i += kCellsAtOnce) add(i, loadLanes<FourNumbers>, storeLanes<FourNumbers>);
  for (; i < size; ++i)
    add(
        i, [](const double* from) { return *from; }, [](double number, double* to) { *to = number; });
  return true;
}

}  // namespace reachlab::analysis
