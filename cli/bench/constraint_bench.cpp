#include "cli/bench/constraint_bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/os.h"
#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/sincos.h"

namespace reachlab::cli {
namespace {

void handTorus(const void*, const double* shape, double u, double v, constraints::SurfacePoint& p) noexcept {
  const double major = shape[0], minor = shape[1];
  double su, cu, sv, cv;
  constraints::sinCos(u, su, cu);
  constraints::sinCos(v, sv, cv);
  const double a = minor * cu, b = minor * su, ring = major + a;
  const double x = ring * cv, y = ring * sv, bc = b * cv, bs = b * sv;
  p.r = {x, y, b};
  p.rU = {-bc, -bs, a};
  p.rV = {-y, x, 0};
  p.rUu = {-(a * cv), -(a * sv), -b};
  p.rUv = {bs, -bc, 0};
  p.rVv = {-x, -y, 0};
}

void handEpitrochoid(const void*, const double* shape, double phi, constraints::CurvePoint& p) noexcept {
  const double a = shape[0], d = shape[1];
  double s, c, s4, c4;
  constraints::sinCos(phi, s, c);
  constraints::sinCos(4 * phi, s4, c4);
  const double as = a * s, ac = a * c, ds = d * s4, dc = d * c4;
  p.r = {ac - dc, as - ds, 0};
  p.rPhi = {4 * ds - as, ac - 4 * dc, 0};
  p.rPhiPhi = {16 * dc - ac, 16 * ds - as, 0};
}

void handMonkeySaddle(const void*, const double* shape, double u, double v, constraints::SurfacePoint& p) noexcept {
  const double width = shape[0], depth = shape[1];
  const double uu = u * u, vv = v * v, six = 6 * depth, sixU = six * u, sixV = six * v;
  p.r = {width * u, width * v, depth * (u * (uu - 3 * vv))};
  p.rU = {width, 0, 3 * depth * (uu - vv)};
  p.rV = {0, width, -(sixU * v)};
  p.rUu = {0, 0, sixU};
  p.rUv = {0, 0, -sixV};
  p.rVv = {0, 0, -sixU};
}

constexpr const char* kHandWritten = "hand-written";

struct Candidate {
  std::string constraint, form;
  constraints::Constraint evaluated;
  bool batch = false;
};

constexpr int kPlaces = 512, kRounds = 60;

// Parameters as a moving mass has them: near the last, never the same.
struct Place {
  double first, second;
};
Place placeOf(int i) { return {-0.9 + 0.0037 * i, 0.3 + 0.0041 * i}; }

constraints::CurveBatch batchFrom(const constraints::Curve& curve, int first) {
  std::array<double, kBatchLanes> phi{};
  for (int lane = 0; lane < kBatchLanes; ++lane) phi[static_cast<std::size_t>(lane)] = placeOf(first + lane).first;
  constraints::CurveBatch points;
  curve.batch(curve.program, curve.shape.data(), phi.data(), points);
  return points;
}

// Every component of r and its derivatives at every place.
std::vector<double> valuesOf(const Candidate& candidate) {
  const constraints::Constraint& c = candidate.evaluated;
  std::vector<double> values;
  const auto put = [&](const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); };
  for (int i = 0; i < kPlaces; ++i) {
    const auto [u, v] = placeOf(i);
    if (candidate.batch) {
      const constraints::CurveBatch points = batchFrom(c.curve, i - i % kBatchLanes);
      const int lane = i % kBatchLanes;
      for (const auto* part : {&points.r, &points.rPhi, &points.rPhiPhi}) put({(*part)[0][lane], (*part)[1][lane], (*part)[2][lane]});
    } else if (c.kind == constraints::ConstraintKind::Curve) {
      const constraints::CurvePoint p = constraints::evaluate(c.curve, u);
      for (const Vec3& part : {p.r, p.rPhi, p.rPhiPhi}) put(part);
    } else {
      const constraints::SurfacePoint p = constraints::evaluate(c.surface, u, v);
      for (const Vec3& part : {p.r, p.rU, p.rV, p.rUu, p.rUv, p.rVv}) put(part);
    }
  }
  return values;
}

double mostApart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

/// [ns] of processor time for one place.
double measure(const Candidate& candidate) {
  const constraints::Constraint& c = candidate.evaluated;
  volatile double used = 0;
  const auto timed = [&](int step, const auto& valueAt) {
    double sink = 0;
    const std::int64_t start = os::threadProcessorTime();
    for (int round = 0; round < kRounds; ++round)
      for (int i = 0; i < kPlaces; i += step) sink += valueAt(i);
    const auto elapsed = static_cast<double>(os::threadProcessorTime() - start);
    used = sink;
    return elapsed / (kRounds * kPlaces);
  };
  if (candidate.batch) return timed(kBatchLanes, [&](int i) { return batchFrom(c.curve, i).rPhiPhi[0][0]; });
  if (c.kind == constraints::ConstraintKind::Curve)
    return timed(1, [&](int i) { return constraints::evaluate(c.curve, placeOf(i).first).rPhiPhi.x; });
  return timed(1, [&](int i) { return constraints::evaluate(c.surface, placeOf(i).first, placeOf(i).second).rVv.x; });
}

std::vector<Candidate> candidates() {
  std::vector<Candidate> list;
  const auto put = [&](const std::string& name, const constraints::Constraint& generated, const constraints::Constraint& typed,
                       constraints::CurveFunction curve, constraints::SurfaceFunction surface) {
    constraints::Constraint hand = generated;
    hand.curve.function = curve;
    hand.surface.function = surface;
    list.push_back({name, kHandWritten, hand});
    list.push_back({name, "generated", generated});
    list.push_back({name, "typed", typed});
    if (generated.kind != constraints::ConstraintKind::Curve) return;
    list.push_back({name, "generated-x8", generated, true});
    list.push_back({name, "typed-x8", typed, true});
  };
  const auto named = [](const char* name) { return constraints::makeConstraint({.name = name, .curve = {}, .surface = {}, .shape = {}}); };
  put("torus", named("torus"),
      constraints::makeConstraint({.name = {},
                                   .curve = {},
                                   .surface = {"(a + b*cos(u))*cos(v)", "(a + b*cos(u))*sin(v)", "b*sin(u)"},
                                   .shape = {{"a", 0.1}, {"b", 0.04}}}),
      nullptr, handTorus);
  put("epitrochoid", named("epitrochoid"),
      constraints::makeConstraint({.name = {},
                                   .curve = {"a*cos(phi) - d*cos(4*phi)", "a*sin(phi) - d*sin(4*phi)", "0"},
                                   .surface = {},
                                   .shape = {{"a", 0.08}, {"d", 0.016}}}),
      handEpitrochoid, nullptr);
  put("monkey-saddle", named("monkey-saddle"),
      constraints::makeConstraint(
          {.name = {}, .curve = {}, .surface = {"w*u", "w*v", "d*(u^3 - 3*u*v^2)"}, .shape = {{"d", 0.05}, {"w", 0.1}}}),
      nullptr, handMonkeySaddle);
  return list;
}

}  // namespace

std::vector<ConstraintEvalRow> benchConstraintEval(int repetitions) {
  const std::vector<Candidate> list = candidates();
  std::vector<std::vector<double>> times(list.size());
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t i = 0; i < list.size(); ++i) times[i].push_back(measure(list[i]));
  std::vector<ConstraintEvalRow> rows;
  std::vector<double> handWritten;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::nth_element(times[i].begin(), times[i].begin() + repetitions / 2, times[i].end());
    const std::vector<double> values = valuesOf(list[i]);
    if (list[i].form == kHandWritten) handWritten = values;
    rows.push_back({list[i].constraint, list[i].form, times[i][static_cast<std::size_t>(repetitions / 2)], mostApart(values, handWritten)});
  }
  return rows;
}

}  // namespace reachlab::cli
