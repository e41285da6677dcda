#include "sim/predict/curve_prediction.h"

#include <algorithm>

#include "sim/predict/transcription.h"

namespace reachlab::predict {

TranscribedProblem makeCurveJerkProblem(const ArcCurve& curve, double duration) {
  constexpr int kLocals = 4;
  TranscribedProblem problem;
  problem.duration = duration;
  problem.locals = kLocals;
  problem.residuals = 3;
  problem.from = {0};
  problem.to = {curve.length()};
  problem.local = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
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
    const std::array<Vec3, kLocals> slope{cube * d[4] + turn * d[3] + a[3] * d[2], 3 * v * v * d[3] + 3 * w * d[2], 3 * v * d[2], d[1]};
    const std::array<std::array<Vec3, kLocals>, kLocals> bend{
        {{cube * d[5] + turn * d[4] + a[3] * d[3]}, {3 * v * v * d[4] + 3 * w * d[3], 6 * v * d[3]}, {3 * v * d[3], 3 * d[2]}, {d[2]}}};
    for (int i = 0; i < kLocals; ++i) {
      put(slope[i], ra + i, kLocals);
      for (int j = 0; j < kLocals; ++j) put(bend[std::max(i, j)][std::min(i, j)], raa + i * kLocals + j, kLocals * kLocals);
    }
  };
  return problem;
}

std::unique_ptr<Prediction> makeCurveJerkPrediction(const constraints::Constraint& constraint, double start, double target, double duration,
                                                    int unknowns) {
  const ArcCurve curve(constraint, start, target, Along::Parameter);
  const TranscribedProblem problem = makeCurveJerkProblem(curve, duration);
  const TranscribedMotion motion = solveFromStarts(problem, unknowns);
  const LegendreSeries place = motion.derivative(0, 0), rate = motion.derivative(0, 1);
  // Arc length along the motion from its speed.
  const GaussRule<double> rule = makeGaussRule<double>(3 * motion.basis.columns() + 40);
  std::vector<double> speed;
  for (const double x : rule.node) speed.push_back(evaluate(rate, x) * norm(curve.expand<2>(evaluate(place, x))[1]));
  const SeriesOfOne hand = makeSeriesOfVelocity(projectOnLegendre(speed, rule.node, rule.weight), duration);
  auto prediction = makeLegendrePrediction(hand, {hand}, duration);
  describeMotion(motion, *prediction);
  prediction->distance = evaluate(hand.position, 1.0);
  prediction->warnings.emplace_back(kMovesAsOne);
  return prediction;
}

}  // namespace reachlab::predict
