#include "constraints/curve_batch.h"

namespace reachlab::constraints {

void evaluateSingly(CurveFunction function, const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept {
  for (int i = 0; i < kBatchLanes; ++i) {
    CurvePoint p;
    function(program, shape, phi[i], p);
    const auto put = [i](double(&to)[3][kBatchLanes], const Vec3& from) { to[0][i] = from.x, to[1][i] = from.y, to[2][i] = from.z; };
    put(out.r, p.r);
    put(out.rPhi, p.rPhi);
    put(out.rPhiPhi, p.rPhiPhi);
  }
}

}  // namespace reachlab::constraints
