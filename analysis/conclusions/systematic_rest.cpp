#include "analysis/conclusions/systematic_rest.h"

#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdlib>

#include "base/math/matrix.h"

namespace reachlab::analysis {
namespace {

constexpr double kFirstPhase = -0.15, kPhaseStep = 0.01;
constexpr std::size_t kPhases = 141;
constexpr std::size_t kMostRows = 200;  // the products of all pairs are computed
constexpr double kLeastSkewness = 1e-6;

/// Means of so many consecutive trials.
template <class Value, class Add>
std::vector<Value> grouped(const std::vector<Value>& values, std::size_t together, Add&& add) {
  std::vector<Value> out;
  for (std::size_t i = 0; i + together <= values.size(); i += together) {
    out.push_back(values[i]);
    for (std::size_t k = 1; k < together; ++k) add(out.back(), values[i + k]);
  }
  return out;
}

std::vector<double> standardised(std::vector<double> durations) {
  double mean = 0, square = 0;
  for (double& x : durations) x = std::log(x), mean += x / static_cast<double>(durations.size());
  for (double& x : durations) x -= mean, square += x * x / static_cast<double>(durations.size());
  for (double& x : durations) x = square > 0 ? x / std::sqrt(square) : 0;
  return durations;
}

}  // namespace

double SystematicRest::p() const {
  if (!(variance > 0)) return 1;
  const double spread = std::sqrt(variance), skewness = third / (variance * spread), z = share / spread;
  if (skewness < kLeastSkewness) return boost::math::cdf(boost::math::complement(boost::math::normal(), z));
  const double shape = 4 / (skewness * skewness), x = shape + z * std::sqrt(shape);
  return x > 0 ? boost::math::cdf(boost::math::complement(boost::math::gamma_distribution<double>(shape), x)) : 1;
}

SystematicRest computeSystematicRest(LaidResiduals residuals, std::vector<double> durations) {
  double square = 0;
  for (const auto& r : residuals)
    for (const double value : r) square += value * value / static_cast<double>(residuals.size());
  if (const std::size_t together = (residuals.size() + kMostRows - 1) / kMostRows; together > 1) {
    const double part = 1 / static_cast<double>(together);
    residuals = grouped(residuals, together, [](auto& sum, const auto& r) {
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += r[k];
    });
    for (auto& r : residuals)
      for (double& value : r) value *= part;
    durations = grouped(durations, together, [](double& product, double factor) { product *= factor; });
    for (double& d : durations) d = std::pow(d, part);
  }
  const auto n = static_cast<Eigen::Index>(residuals.size());
  if (n < 3 || !(square > 0)) return {};
  Eigen::MatrixXd rows(n, static_cast<Eigen::Index>(residuals.front().size()));
  for (Eigen::Index i = 0; i < n; ++i)
    rows.row(i) = Eigen::Map<const Eigen::RowVectorXd>(residuals[static_cast<std::size_t>(i)].data(), rows.cols());
  const std::vector<double> x = standardised(std::move(durations));
  Eigen::MatrixXd products = rows * rows.transpose();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      products(i, j) *= std::abs(i - j) > 1 ? 1 + x[static_cast<std::size_t>(i)] * x[static_cast<std::size_t>(j)] : 0;
  const double scale = static_cast<double>((n - 1) * (n - 2)) * square;
  SystematicRest out;
  out.share = products.sum() / scale;
  out.variance = 2 * products.squaredNorm() / (scale * scale);
  out.third = 8 * (products * products).cwiseProduct(products).sum() / (scale * scale * scale);
  return out;
}

std::vector<double> layResidual(const FitWindow& window, std::span<const double> residual, const MovementFit& place) {
  std::vector<double> out(kPhases);
  const auto weighed = [&](std::size_t i) { return std::sqrt(window.weight[i]) * residual[i]; };
  for (std::size_t k = 0; k < kPhases; ++k) {
    const double t = place.onset + place.duration * (kFirstPhase + kPhaseStep * static_cast<double>(k));
    const double x = (t - window.begin) * window.rate;
    if (!(x >= 0) || x + 1 >= static_cast<double>(residual.size())) continue;
    const auto i = static_cast<std::size_t>(x);
    const double part = x - static_cast<double>(i);
    out[k] = (1 - part) * weighed(i) + part * weighed(i + 1);
  }
  return out;
}

/// Two candidates nearer to each other than this part of what the one leaves are one: between them there is no share of the way.
constexpr double kLeastWay = 1e-3;

std::vector<std::vector<double>> computeSharesOfOthers(std::span<const LaidResiduals> fits, std::size_t of) {
  const LaidResiduals& own = fits[of];
  std::vector<std::vector<double>> out;
  for (const LaidResiduals& other : fits) {
    std::vector<double> sum(kPhases);
    for (std::size_t i = 0; i < own.size(); ++i)
      for (std::size_t k = 0; k < kPhases; ++k) sum[k] += own[i][k] - other[i][k];
    std::vector<double>& shares = out.emplace_back();
    for (std::size_t i = 0; i < own.size(); ++i) {
      double along = 0, square = 0, rest = 0;
      for (std::size_t k = 0; k < kPhases; ++k) {
        const double way = (sum[k] - (own[i][k] - other[i][k])) / static_cast<double>(own.size() - 1);
        along += own[i][k] * way, square += way * way, rest += own[i][k] * own[i][k];
      }
      shares.push_back(square > kLeastWay * kLeastWay * rest ? along / square : 0);
    }
  }
  return out;
}

SystematicRest meanOf(std::span<const SystematicRest> rests) {
  SystematicRest out;
  const double n = static_cast<double>(rests.size());
  for (const SystematicRest& r : rests) out.share += r.share / n, out.variance += r.variance / (n * n), out.third += r.third / (n * n * n);
  return out;
}

}  // namespace reachlab::analysis
