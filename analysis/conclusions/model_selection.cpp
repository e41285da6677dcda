#include "analysis/conclusions/model_selection.h"

#include <algorithm>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/policies/policy.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

#include "analysis/measures/statistics.h"

namespace reachlab::analysis {
namespace {

/// Double precision is enough, and several times as fast as Boost's default.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
double digamma(double x) { return boost::math::digamma(x, InDouble()); }
double lgamma(double x) { return boost::math::lgamma(x, InDouble()); }

/// Gamma(x; alpha_c) prod_{j != c} G(x; alpha_j): Dirichlet frequencies are gamma variables over their sum.
std::vector<double> exceedanceOf(const std::vector<double>& alpha) {
  constexpr int kPanels = 48;
  const double largest = *std::max_element(alpha.begin(), alpha.end());
  const double end = boost::math::quantile(boost::math::complement(boost::math::gamma_distribution<double>(largest), 1e-13));
  std::vector<double> out(alpha.size(), 0.0);
  std::vector<double> below(alpha.size());
  const auto add = [&](double x, double weight) {
    for (std::size_t j = 0; j < alpha.size(); ++j) below[j] = boost::math::gamma_p(alpha[j], x, InDouble());
    for (std::size_t c = 0; c < alpha.size(); ++c) {
      double value = weight * boost::math::gamma_p_derivative(alpha[c], x, InDouble());
      for (std::size_t j = 0; j < alpha.size(); ++j)
        if (j != c) value *= below[j];
      out[c] += value;
    }
  };
  using Rule = boost::math::quadrature::gauss<double, 10>;
  for (int p = 0; p < kPanels; ++p) {
    const double half = end / kPanels / 2, middle = (2 * p + 1) * half;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
      for (const double side : {-1.0, 1.0}) add(middle + side * half * Rule::abscissa()[i], half * Rule::weights()[i]);
  }
  const double sum = sumOf(out);  // 1 but for the rule's error
  for (double& x : out) x /= sum;
  return out;
}

}  // namespace

ModelSelection selectModel(const std::vector<std::vector<double>>& evidence) {
  const std::size_t people = evidence.size(), models = evidence.front().size();
  const double k = static_cast<double>(models);
  ModelSelection out;
  out.alpha.assign(models, 1 + static_cast<double>(people) / k);
  std::vector<std::vector<double>> share(people, std::vector<double>(models));
  const auto assign = [&] {
    const double whole = digamma(sumOf(out.alpha));
    for (std::size_t s = 0; s < people; ++s) {
      double most = -std::numeric_limits<double>::infinity(), sum = 0;
      for (std::size_t m = 0; m < models; ++m) most = std::max(most, share[s][m] = evidence[s][m] + digamma(out.alpha[m]) - whole);
      for (double& g : share[s]) sum += g = std::exp(g - most);
      for (double& g : share[s]) g /= sum;
    }
  };
  for (int round = 0; round < 1000; ++round) {
    assign();
    double moved = 0;
    for (std::size_t m = 0; m < models; ++m) {
      double next = 1;
      for (std::size_t s = 0; s < people; ++s) next += share[s][m];
      moved = std::max(moved, std::abs(next - out.alpha[m]));
      out.alpha[m] = next;
    }
    if (moved < 1e-10) break;
  }
  assign();
  out.exceedance = exceedanceOf(out.alpha);

  // Free energies: frequencies that may differ against equal ones (Rigoux 2014, appendix).
  const double whole = sumOf(out.alpha);
  double differ = lgamma(k) - lgamma(whole), equal = 0;
  for (std::size_t m = 0; m < models; ++m) {
    const double logFrequency = digamma(out.alpha[m]) - digamma(whole);
    differ += lgamma(out.alpha[m]) - (out.alpha[m] - 1) * logFrequency;
    for (std::size_t s = 0; s < people; ++s)
      if (const double g = share[s][m]; g > 0) differ += g * (evidence[s][m] + logFrequency - std::log(g));
  }
  for (const auto& person : evidence) {
    const double most = *std::max_element(person.begin(), person.end());
    double sum = 0;
    for (const double l : person) sum += std::exp(l - most);
    equal += most + std::log(sum / k);
  }
  out.omnibusRisk = 1 / (1 + std::exp(std::clamp(differ - equal, -700.0, 700.0)));
  for (const double x : out.exceedance) out.protectedExceedance.push_back(x * (1 - out.omnibusRisk) + out.omnibusRisk / k);
  return out;
}

}  // namespace reachlab::analysis
