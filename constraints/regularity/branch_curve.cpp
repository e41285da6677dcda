#include "constraints/regularity/branch_curve.h"

#include <algorithm>
#include <cmath>

#include "constraints/curve_batch.h"

namespace reachlab::constraints {
namespace {

constexpr double kContinuous = 1e-9;  // of a millimetre and of the curve's size: what counts as no jump
constexpr double kRounding = 1e-12;   // of |r|, for a curve may lie far away, and of phi
constexpr double kLost = 1e-10;       // [m] a mass moves this far by a rounding of phi: nearer a pole phi tells places apart no more,
constexpr double kFarLost = 1e-15;    // or this part of |r|, which is rounded itself
constexpr double kSteepest = 1e12;    // [m] |r_phi|: what is steeper has no end that phi comes to

void evaluateBranch(const void* data, const double* shape, double phi, CurvePoint& out) noexcept {
  const BranchCurve& branch = *static_cast<const BranchCurve*>(data);
  const double at = std::fmin(std::fmax(phi, branch.lo), branch.hi);
  evaluateCurveProgram(branch.program.get(), shape, at, out);
  if (at == phi) return;
  out.r += (phi - at) * out.rPhi;
  out.rPhiPhi = {};
}
void evaluateBranchBatch(const void* data, const double* shape, const double* phi, CurveBatch& out) noexcept {
  evaluateSingly(evaluateBranch, data, shape, phi, out);
}

/// A branch seen from its end: distances are into it.
class EndExaminer {
 public:
  EndExaminer(const Program& program, const double* shape, double boundary, double inwards)
      : program_(program), shape_(shape), b_(boundary), width_(std::abs(inwards)), direction_(inwards > 0 ? 1 : -1),
        unit_(std::max(1.0, std::abs(boundary))) {}

  BranchEnd examine(bool branching) const {
    BranchEnd end;
    end.edge = end.stop = b_;
    end.limit = at(b_);
    if (branching && isFinite(end.limit) && hasItsValueThere(end)) return end;
    takeLimit(end);
    if (end.valid && !end.settled) end.edge = end.stop = findStop();
    return end;
  }

 private:
  CurvePoint at(double phi) const {
    CurvePoint p;
    evaluateCurveProgram(&program_, shape_, phi, p);
    return p;
  }
  CurvePoint inside(double distance) const { return at(b_ + direction_ * distance); }
  /// Where the tangent at `distance` comes to at the boundary.
  Vec3 extrapolate(const CurvePoint& p, double distance) const { return p.r - (direction_ * distance) * p.rPhi; }
  /// [m] by how much two limits may differ that are one.
  double slackOf(const CurvePoint& p) const {
    double move = norm(inside(std::min(0.3 * width_, 1.0)).r - p.r);  // how far a unit of phi leads from there
    if (!std::isfinite(move)) move = 0;
    return kContinuous * (1e-3 + std::min(move, norm(p.r))) + kRounding * (norm(p.r) + norm(p.rPhi) * unit_);
  }
  /// A value on the boundary need not be a limit: atan2(0, 0) is 0, or pi.
  bool hasItsValueThere(BranchEnd& end) const {
    const double close = std::min(0.1 * width_, 1e-7 * unit_);
    const CurvePoint p = inside(close);
    end.slack = slackOf(p);
    end.exact = isFinite(p) && norm(extrapolate(p, close) - end.limit.r) <= end.slack;
    if (end.exact) end.valid = true;
    return end.exact;
  }
  /// The limit, from three places ever nearer to the boundary.
  void takeLimit(BranchEnd& end) const {
    const double far = std::min(0.1 * width_, 1e-5 * unit_), near = 0.1 * far, nearer = 0.01 * near;
    const CurvePoint a = inside(far), n = inside(near), m = inside(nearer);
    end.valid = reachlab::isFinite(a.r) && reachlab::isFinite(n.r) && isFinite(inside(0.3 * width_));
    if (!end.valid) return;
    end.edge = end.stop = b_ + direction_ * near;
    end.limit = n;
    end.limit.r = extrapolate(n, near);
    const double size = 1e-3 + norm(n.r);
    end.slack = slackOf(n);
    end.settled = isFinite(n) && norm(extrapolate(a, far) - end.limit.r) <= end.slack;
    const double first = norm(n.r - a.r), then = norm(m.r - n.r);
    // A logarithm gains twice as much over two decades as over one, a power of more than -0.01 less.
    end.bounded = reachlab::isFinite(m.r) && then <= 1.95 * first + 1e-12 * size;
  }
  /// As near to the boundary as phi tells places apart.
  double findStop() const {
    const double near = 0.1 * std::min(0.1 * width_, 1e-5 * unit_), most = 0.3 * width_;
    double distance = near;
    while (distance < most && isLost(inside(distance), distance)) distance *= 2;
    double stop = b_ + direction_ * std::min(distance, most);
    for (; distance <= near && distance > 1e-15 * unit_; distance *= 0.5) {
      const CurvePoint p = inside(distance);
      if (isLost(p, distance)) break;
      stop = b_ + direction_ * distance;
      if (norm(p.rPhi) * distance < 1e-12) break;  // [m] to go
    }
    return stop;
  }
  bool isLost(const CurvePoint& p, double distance) const {
    constexpr double kRounded = 2.3e-16;  // of phi
    return !isFinite(p) || norm(p.rPhi) * kRounded * std::abs(b_ + direction_ * distance) > std::max(kLost, kFarLost * norm(p.r)) ||
           norm(p.rPhi) > kSteepest;
  }

  const Program& program_;
  const double* shape_;
  double b_, width_, direction_, unit_;
};

}  // namespace

Curve curveOf(const BranchCurve& branch, const Curve& whole) { return {evaluateBranch, evaluateBranchBatch, &branch, whole.shape}; }

BranchEnd examineEnd(const Program& program, const double* shape, double boundary, double inwards, bool branching) {
  return EndExaminer(program, shape, boundary, inwards).examine(branching);
}

bool isFinite(const CurvePoint& p) noexcept {
  return reachlab::isFinite(p.r) && reachlab::isFinite(p.rPhi) && reachlab::isFinite(p.rPhiPhi);
}

}  // namespace reachlab::constraints
