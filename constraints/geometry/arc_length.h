#pragma once
#include <optional>
#include <vector>

#include "base/math/legendre_series.h"
#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// The parameter of a curve as a function of the arc length from one of its points, to 1e-12 of the whole. |r_phi| is a Legendre series on
/// each piece. Pieces are halved until sixteen terms resolve them, or until their length no longer counts (cusps, kinks, changes of pace).
/// Made once. A query costs one search and a few steps of Newton's method. A value. Any thread.
class ArcLength {
 public:
  /// `from` and `to` are parameters. Throws RefusedError where the curve has no value between them, and for a curve that would need
  /// more than kMaxPieces pieces.
  ArcLength(const Constraint& curve, double from, double to);
  static constexpr int kMaxPieces = 20000;

  double length() const { return length_; }  // [m] >= 0
  /// The parameter after `s` [m] of the curve, s in [0, length()]. Beyond this range it is the parameter of the nearer end.
  double parameterAt(double s) const;

 private:
  struct Piece {
    double begin = 0, half = 0;  // parameter at its beginning; half of what it covers, with sign
    double from = 0;             // [m] done before it
    LegendreSeries rate, done;   // ds/dx and s - from over x in [-1, 1]
  };
  void append(const Constraint& curve, double begin, double end, int depth);

  std::vector<Piece> pieces_;
  double length_ = 0, rough_ = 0;
};

/// The parameter that lies `s` [m] of the curve behind `from`, towards higher parameters for s > 0. nullopt if the curve ends before.
std::optional<double> parameterAfter(const Constraint& curve, double from, double s);

}  // namespace reachlab::constraints
