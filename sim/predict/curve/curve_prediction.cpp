#include "sim/predict/curve/path_predictions.h"

#include <algorithm>

#include "base/error.h"
#include "sim/predict/transcription/transcription.h"

namespace reachlab::predict {

TranscribedProblem makeCurveJerkProblem(const constraints::ArcCurve& curve, double duration) {
  constexpr int kLocals = 4;
  TranscribedProblem problem;
  problem.duration = duration;
  problem.residuals = 3;
  problem.from = {0};
  problem.to = {curve.length()};
  problem.takeDerivativesAsLocals();
  problem.residual = [&curve](const double* a, double* r, double* ra, double* raa) {
    const double v = a[1], w = a[2], cube = v * v * v, turn = 3 * v * w;
    const auto put = [](const Vec3& from, double* to, int stride) { to[0] = from.x, to[stride] = from.y, to[2 * stride] = from.z; };
    if (ra == nullptr) {
      const auto d = curve.expand<3>(a[0]);
      put(cube * d[3] + turn * d[2] + a[3] * d[1], r, 1);
      return;
    }
    const auto d = curve.expand<5>(a[0]);
    put(cube * d[3] + turn * d[2] + a[3] * d[1], r, 1);
    const std::array<Vec3, kLocals> gradient{cube * d[4] + turn * d[3] + a[3] * d[2], 3 * v * v * d[3] + 3 * w * d[2], 3 * v * d[2], d[1]};
    const std::array<std::array<Vec3, kLocals>, kLocals> hessian{
        {{cube * d[5] + turn * d[4] + a[3] * d[3]}, {3 * v * v * d[4] + 3 * w * d[3], 6 * v * d[3]}, {3 * v * d[3], 3 * d[2]}, {d[2]}}};
    for (int i = 0; i < kLocals; ++i) {
      put(gradient[i], ra + i, kLocals);
      for (int j = 0; j < kLocals; ++j) put(hessian[std::max(i, j)][std::min(i, j)], raa + i * kLocals + j, kLocals * kLocals);
    }
  };
  return problem;
}

std::unique_ptr<Prediction> makeCurveJerkPrediction(const constraints::Constraint& constraint, double start, double target, double duration,
                                                    int unknowns) {
  const constraints::ArcCurve curve = [&] {
    try {
      return constraints::ArcCurve(constraint, start, target, constraints::Along::Parameter);
    } catch (const RefusedError&) {  // the curve itself may be smooth where its parameter changes its pace
      return constraints::ArcCurve(constraint, start, target);
    }
  }();
  const TranscribedProblem problem = makeCurveJerkProblem(curve, duration);
  const TranscribedMotion motion = solveFromStarts(problem, unknowns, [&](const TranscribedMotion& found, double t) {
    const auto [s, v, a, j] = found.at(0, t);
    const auto d = curve.expand<3>(s);
    return PathPoint{d[0], v * d[1], v * v * d[2] + a * d[1], v * v * v * d[3] + 3 * v * a * d[2] + j * d[1]};
  });
  const LegendreSeries place = motion.derivative(0, 0), rate = motion.derivative(0, 1);
  const MotionSeries hand = makeSeriesOfSpeed(
      [&](double t) {
        const double x = 2 * t / duration - 1;
        return valueAt(rate, x) * norm(curve.expand<2>(valueAt(place, x))[1]);
      },
      motion.basis.columns(), duration);
  auto prediction = makeLegendrePrediction(hand, {hand}, duration);
  describeMotion(motion, *prediction);
  prediction->distance = valueAt(hand.position, 1.0);
  prediction->warnings.emplace_back(kMovesAsOne);
  return prediction;
}

}  // namespace reachlab::predict
