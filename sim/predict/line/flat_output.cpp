#include "sim/predict/line/flat_output.h"

#include <algorithm>

namespace reachlab::predict {
namespace {

FlatPolynomial operator*(const FlatPolynomial& a, const FlatPolynomial& b) {
  FlatPolynomial c(a.size() + b.size() - 1, 0);
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

FlatPolynomial operator+(FlatPolynomial a, const FlatPolynomial& b) {
  a.resize(std::max(a.size(), b.size()), 0);
  for (size_t i = 0; i < b.size(); ++i) a[i] += b[i];
  return a;
}

// Node 0 is the hand, node i the i-th mass; each is its polynomial applied to z.
std::vector<FlatPolynomial> computeChain(const LineObject& object) {
  const int n = object.count();
  std::vector<FlatPolynomial> node(n + 1);
  // X_i = x_i / (kappa_0 … kappa_(i-1)) and the elongation d_i likewise: k_(i-1) d_(i-1) = (m_i D^2 + lambda D) X_i + k_i kappa_i
  // d_i.
  const auto kappa = [&](int i) { return FlatPolynomial{1, static_cast<long double>(object.dampers[i]) / object.springs[i]}; };
  node[n] = {1};
  FlatPolynomial elongation{0};
  for (int i = n; i > 0; --i) {
    const long double k = object.springs[i - 1];
    FlatPolynomial next = FlatPolynomial{0, object.viscosity[i - 1] / k, object.masses[i - 1] / k} * node[i];
    if (i < n) next = next + FlatPolynomial{object.springs[i] / k} * (kappa(i) * elongation);
    elongation = next;
    node[i - 1] = elongation + kappa(i - 1) * node[i];
  }
  FlatPolynomial product{1};
  for (int i = 1; i <= n; ++i) {
    product = product * kappa(i - 1);
    node[i] = node[i] * product;
  }
  return node;
}

std::vector<FlatPolynomial> computeParallel(const LineObject& object) {
  const int n = object.count();
  std::vector<FlatPolynomial> node(n + 1, FlatPolynomial{1});
  for (int j = 0; j < n; ++j) {
    const long double k = object.springs[j];
    const FlatPolynomial oscillator{1, (static_cast<long double>(object.dampers[j]) + object.viscosity[j]) / k, object.masses[j] / k};
    for (int i = 0; i <= n; ++i)
      node[i] = node[i] * (i == j + 1 ? FlatPolynomial{1, static_cast<long double>(object.dampers[j]) / k} : oscillator);
  }
  return node;
}

}  // namespace

std::vector<FlatPolynomial> computeFlatPolynomials(const LineObject& object) {
  return object.parallel ? computeParallel(object) : computeChain(object);
}

}  // namespace reachlab::predict
