#pragma once
#include <array>
#include <vector>

#include "constraints/constraint.h"

namespace reachlab::predict {

/// What s is: metres of arc length, or the curve's own parameter from the start on, |phi - start|, which passes near a cusp more
/// smoothly.
enum class Along { ArcLength, Parameter };

/// A curve of the catalogue as a function of its arc length s [m] from the task's start (s = 0) to its target (s = length()), and
/// as far beyond both ends as the curve goes smoothly, at most half the way. Pieces of high degree through the curvature vector
/// r_ss = (r_ff - T (T.r_ff)) / |r_f|^2, integrated twice, so that r and its first five derivatives are known to about 1e-12 of
/// their size. Beyond the known part it goes on straight, so that an iteration may look there; a result must stay within
/// [lowest(), highest()]. A value; any thread.
class ArcCurve {
 public:
  /// Throws RefusedError where the curve has a cusp, stands still or breaks off between start and target (constraint parameters).
  ArcCurve(const constraints::Constraint& curve, double start, double target, Along along = Along::ArcLength);

  /// The first `part` of the way, magnified to the whole length: r(part s)/part, from a straight line (part 0) to the curve
  /// itself (1). For continuation from a straight line to any curve.
  ArcCurve magnified(double part) const;

  double length() const { return length_; }
  /// Largest |r_phi| between start and target, of the smallest.
  double unevenness() const { return unevenness_; }
  double lowest() const { return pieces_.front().from; }
  double highest() const { return pieces_.back().to; }

  /// r and its derivatives with respect to s up to `Order` <= 5: [m], tangent, curvature vector [1/m] …
  template <int Order>
  std::array<Vec3, Order + 1> expand(double s) const;

 private:
  static constexpr int kNodes = 16, kTerms = kNodes + 2;
  struct Piece {
    double from = 0, to = 0;                               // [m]
    std::array<std::array<double, 3>, kTerms> position{};  // [m] powers of x = (2 s - from - to) / (to - from)
  };
  bool append(const constraints::Curve& curve, double phi, double phiEnd, int depth);
  const Piece& pieceAt(double s) const;
  template <int Order>
  std::array<Vec3, Order + 1> expandWhole(double s) const;

  Along along_;
  std::vector<Piece> pieces_;
  double length_ = 0;
  double unevenness_ = 1, part_ = 1;
};

}  // namespace reachlab::predict
