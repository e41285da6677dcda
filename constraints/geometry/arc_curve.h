#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/math/legendre_series.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {

/// The meaning of s: metres of arc length, or |phi - start| in the curve's parameter, which passes near a cusp more smoothly.
enum class Along { ArcLength, Parameter };

/// Where and why a curve cannot be followed smoothly.
struct CurveBreak {
  double phi = 0;
  std::string what;  // "a kink (its direction turns by 53 degrees)"
};

/// A curve of the catalogue as a function of its arc length s [m] from the task's start (s = 0) to its target (s = length()). It is known
/// as far beyond both ends as the curve is smooth, at most half the length. It consists of pieces of high degree through the curvature
/// vector r_ss = (r_ff - T (T.r_ff)) / |r_f|^2, integrated twice. So r and its first five derivatives are known to about 1e-12 of their
/// size. The pieces are compared with the formula at many positions, and with each other where they meet, so that no kink, jump or narrow
/// bump is overlooked. Beyond the known part the curve continues straight, so that an iteration may look there. A result must stay within
/// [lowest(), highest()]. A value. Any thread.
class ArcCurve {
 public:
  /// Throws RefusedError, with the position, where the curve between start and target (constraint parameters) is not smooth: a kink, a
  /// jump, a cusp, a step of its curvature, a standstill or a missing value. Such a position is allowed at the start or target, where the
  /// hand rests.
  ArcCurve(const Constraint& curve, double start, double target, Along along = Along::ArcLength);

  /// The first `part` of the curve, magnified to the whole length: r(part s)/part. Part 0 is a straight line and part 1 the curve itself.
  /// For continuation from a straight line to any curve.
  ArcCurve magnified(double part) const;

  double length() const { return length_; }
  double lowest() const { return pieces_.front().from; }
  double highest() const { return pieces_.back().to; }

  /// r and its derivatives with respect to s up to `Order` <= 5: [m], tangent, curvature vector [1/m] …
  template <int Order>
  std::array<Vec3, Order + 1> expand(double s) const;

 private:
  static constexpr int kNodes = 16, kTerms = kNodes + 2;
  struct Piece {
    double from = 0, to = 0;              // [m]
    double begin = 0;                     // parameter where it begins
    bool isShort = false;                 // a change of pace
    std::array<Vec3, kTerms> position{};  // [m] powers of x = (2 s - from - to) / (to - from)
  };
  bool append(double phi, double phiEnd, int depth);
  bool appendShort(double phi, double phiEnd);
  bool fits(const Piece& piece, double phi, double phiEnd, const LegendreSeries& arc) const;
  bool joins(const Piece& before, const Piece& after);
  size_t countJoined();
  template <int Order>
  static std::array<Vec3, Order + 1> expand(const Piece& piece, double x);
  bool breakOff(double phi, std::string what);
  const Piece& pieceAt(double s) const;
  template <int Order>
  std::array<Vec3, Order + 1> expandWhole(double s) const;

  Along along_;
  Curve curve_;
  double way_ = 0;      // of the parameter, from start to target
  double fastest_ = 0;  // [m] |r_phi| between them
  CurveBreak break_;
  std::vector<Piece> pieces_;
  double length_ = 0;
  double part_ = 1;
};

}  // namespace reachlab::constraints
