#pragma once
#include <memory>

namespace reachlab::dynamics {

/// The coefficients of Radau IIA of order 5, and its linear systems (1 - h A x J) x = b, for any number of states. Only the constructor
/// allocates.
class RadauMatrix {
 public:
  static constexpr int kStages = 3;
  static constexpr double kRoot6 = 2.449489742783178;
  static constexpr double kC[kStages] = {(4 - kRoot6) / 10, (4 + kRoot6) / 10, 1};
  static constexpr double kA[kStages][kStages] = {{(88 - 7 * kRoot6) / 360, (296 - 169 * kRoot6) / 1800, (-2 + 3 * kRoot6) / 225},
                                                  {(296 + 169 * kRoot6) / 1800, (88 + 7 * kRoot6) / 360, (-2 - 3 * kRoot6) / 225},
                                                  {(16 - kRoot6) / 36, (16 + kRoot6) / 36, 1.0 / 9}};

  explicit RadauMatrix(int states);
  ~RadauMatrix();

  /// J = df/dy, row by row.
  double* jacobian() noexcept { return jacobian_.get(); }
  /// b, and x after solve().
  double* right() noexcept;
  /// False if the matrix is singular.
  bool factorise(double h) noexcept;
  void solve() noexcept;

 private:
  struct Factors;
  int n_;
  std::unique_ptr<double[]> jacobian_;
  std::unique_ptr<Factors> factors_;
};

}  // namespace reachlab::dynamics
