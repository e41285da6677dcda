#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "bench/quad.h"

/// The exact step of a linear scene in 113 bits.
namespace reachlab::bench {

inline constexpr int kHandTerms = 6;  // the hand is a quintic: itself and five derivatives

class Matrix {
 public:
  explicit Matrix(int n) : n_(n), a_(n * n, Quad(0)) {}
  Quad& operator()(int i, int j) { return a_[i * n_ + j]; }
  const Quad& operator()(int i, int j) const { return a_[i * n_ + j]; }
  int size() const { return n_; }
  static Matrix identity(int n) {
    Matrix m(n);
    for (int i = 0; i < n; ++i) m(i, i) = 1;
    return m;
  }

 private:
  int n_;
  std::vector<Quad> a_;
};

inline Matrix multiply(const Matrix& a, const Matrix& b, const Quad& factor) {
  const int n = a.size();
  Matrix c(n);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Quad f = a(i, k) * factor;
      if (f == 0) continue;
      for (int j = 0; j < n; ++j) c(i, j) += f * b(k, j);
    }
  return c;
}

inline Matrix exponential(Matrix a) {
  const int n = a.size();
  double norm = 0;
  for (int i = 0; i < n; ++i) {
    double row = 0;
    for (int j = 0; j < n; ++j) row += std::abs(static_cast<double>(a(i, j)));
    norm = std::max(norm, row);
  }
  const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(norm * 4))));
  const Quad scale = 1 / Quad(std::ldexp(1.0, squarings));
  Matrix sum = Matrix::identity(n), term = sum;
  for (int k = 1; k <= 26; ++k) {  // (1/4)^26 / 26! = 5e-43
    term = multiply(term, a, scale / k);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) sum(i, j) += term(i, j);
  }
  for (int i = 0; i < squarings; ++i) sum = multiply(sum, sum, 1);
  return sum;
}

/// exp(A dt) of the state and the hand's derivatives together.
template <class System>
Matrix stateAndHandStep(const System& system, const Quad& dt) {
  constexpr int kStates = 2 * System::kCoordinates, kAll = kStates + kHandTerms;
  const double x0 = system.x0;
  // The columns of A, read off the right-hand side at unit vectors (it is linear, and zero at rest under the hand).
  Matrix a(kAll);
  for (int j = 0; j < kStates + 2; ++j) {
    std::array<Quad, kStates> y{}, dy{};
    Quad r[3] = {x0, 0, 0}, v[3] = {0, 0, 0};
    if (j < kStates) y[j] = 1;
    if (j == kStates) r[0] += 1;
    if (j == kStates + 1) v[0] = 1;
    system.rate(y.data(), r, v, dy.data());
    for (int i = 0; i < kStates; ++i) a(i, j) = dy[i] * dt;
  }
  for (int k = 0; k + 1 < kHandTerms; ++k) a(kStates + k, kStates + k + 1) = dt;
  return exponential(a);
}

}  // namespace reachlab::bench
