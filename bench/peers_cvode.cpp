#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cmath>

#include "base/ticks.h"
#include "bench/peer_system.h"
#include "bench/peers.h"

namespace reachlab::bench {
namespace {

/// CVODE's objects, released together. Adams with fixed-point iteration, or BDF with a dense Newton matrix.
template <class System>
struct CvodeRun {
  static constexpr int n = 2 * System::kCoordinates;
  BenchScene scene;
  PeerSystem<System> peer;
  Segments segments;
  SUNContext context = nullptr;
  N_Vector y = nullptr;
  void* memory = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  SUNNonlinearSolver nonlinear = nullptr;

  CvodeRun(const BenchScene& s, const System& system, bool stiff, double tolerance)
      : scene(s), peer{system}, segments(makeSegments(s, kTickSeconds)) {
    SUNContext_Create(nullptr, &context);
    y = N_VNew_Serial(n, context);
    setInitialState<System>(scene, N_VGetArrayPointer(y));
    memory = CVodeCreate(stiff ? CV_BDF : CV_ADAMS, context);
    CVodeInit(memory, &rate, 0, y);
    CVodeSStolerances(memory, tolerance, tolerance);
    CVodeSetUserData(memory, this);
    CVodeSetMaxNumSteps(memory, 20'000);
    if (stiff) {
      matrix = SUNDenseMatrix(n, n, context);
      linear = SUNLinSol_Dense(y, matrix, context);
      CVodeSetLinearSolver(memory, linear, matrix);
    } else {
      nonlinear = SUNNonlinSol_FixedPoint(y, 0, context);
      CVodeSetNonlinearSolver(memory, nonlinear);
    }
  }
  CvodeRun(const CvodeRun&) = delete;
  CvodeRun& operator=(const CvodeRun&) = delete;
  ~CvodeRun() {
    CVodeFree(&memory);
    if (nonlinear) SUNNonlinSolFree(nonlinear);
    if (linear) SUNLinSolFree(linear);
    if (matrix) SUNMatDestroy(matrix);
    N_VDestroy(y);
    SUNContext_Free(&context);
  }

  // Time runs on through the reach; the segment's own time is what has passed since the tick began.
  double tickStart = 0;
  static int rate(realtype t, N_Vector state, N_Vector slope, void* self) {
    auto& run = *static_cast<CvodeRun*>(self);
    run.peer.rate(N_VGetArrayPointer(state), N_VGetArrayPointer(slope), t - run.tickStart);
    return 0;
  }

  void operator()(Trajectory* out) {
    setInitialState<System>(scene, N_VGetArrayPointer(y));
    CVodeReInit(memory, 0, y);
    tickStart = 0;
    std::size_t tick = 0;
    runReach(peer, *segments, N_VGetArrayPointer(y), out, [&] {
      tickStart = static_cast<double>(tick) * kTickSeconds;
      const double end = static_cast<double>(++tick) * kTickSeconds;
      CVodeSetStopTime(memory, end);
      realtype reached = 0;
      return CVode(memory, end, y, &reached, CV_NORMAL) >= 0;
    });
    long steps = 0;
    CVodeGetNumSteps(memory, &steps);
    if (out) out->steps = static_cast<std::uint64_t>(steps);
  }
};

template <class System>
Contender makeCvode(const BenchScene& scene, const System& system, bool stiff, double tolerance) {
  auto run = std::make_shared<CvodeRun<System>>(scene, system, stiff, tolerance);
  Contender out;
  out.method = stiff ? "cvode-bdf" : "cvode-adams", out.tolerance = tolerance;
  out.run = [run](Trajectory* trajectory) { (*run)(trajectory); };
  return out;
}

}  // namespace

std::vector<Contender> makeCvodePeers(const BenchScene& scene) {
  std::vector<Contender> all;
  visitSystem(scene, [&]<class System>(const System& system) {
    for (int digits = 6; digits <= 13; digits += 1) {
      const double tolerance = std::pow(10.0, -digits);
      all.push_back(makeCvode(scene, system, false, tolerance));
      // A dense matrix of a thousand states takes seconds for one reach and wins nothing.
      if constexpr (System::kCoordinates <= 50) all.push_back(makeCvode(scene, system, true, tolerance));
    }
  });
  return all;
}

}  // namespace reachlab::bench
