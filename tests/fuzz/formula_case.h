#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/fault.h"
#include "constraints/constraint.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/cpp_writer.h"
#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// Throws where eight points together differ from single ones, not-a-numbers being all alike.
inline void requireBatchOfSinglePoints(const Curve& curve, const std::array<double, kBatchLanes>& phi) {
  CurveBatch batch;
  curve.batch(curve.program, curve.shape.data(), phi.data(), batch);
  for (int lane = 0; lane < kBatchLanes; ++lane) {
    const CurvePoint p = evaluate(curve, phi[static_cast<std::size_t>(lane)]);
    const auto same = [lane](const double(&lanes)[3][kBatchLanes], const Vec3& v) {
      const auto equal = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
      return equal(lanes[0][lane], v.x) && equal(lanes[1][lane], v.y) && equal(lanes[2][lane], v.z);
    };
    if (!same(batch.r, p.r) || !same(batch.rPhi, p.rPhi) || !same(batch.rPhiPhi, p.rPhiPhi))
      throw std::logic_error("eight points together differ from single ones");
  }
}

/// One case of the formula fuzzer: three lines are a surface, otherwise the first line is the x of a curve, through the whole pipeline. Any
/// text must end as a constraint that evaluates or as a FaultError; what else happens is a bug, and thrown.
inline void runFormulaCase(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') lines.emplace_back();
    else lines.back() += c;
  }
  ConstraintSpec spec;
  spec.name.clear();
  if (lines.size() == 3) spec.surface = lines;
  else spec.curve = {lines[0], "phi", "a"};
  spec.shape = {{"a", 0.3}};
  FormulaText formula{lines.size() == 3 ? ConstraintKind::Surface : ConstraintKind::Curve, {}, {"a"}};
  for (std::size_t k = 0; k < 3; ++k) formula.coordinates[k] = lines.size() == 3 ? spec.surface[k] : spec.curve[k];
  for (const FormulaFault& fault : formulaFaults(formula))
    if (fault.coordinate >= 0 &&
        fault.position >
            std::max<std::size_t>(formula.coordinates[static_cast<std::size_t>(fault.coordinate)].size(), kMaxFormulaCharacters))
      throw std::logic_error("a fault is placed beyond the text");
  try {
    const Constraint c = makeConstraint(spec);
    if (c.kind == ConstraintKind::Curve) {
      requireBatchOfSinglePoints(c.curve, {0.0, 0.37, -1.5, 2.0, 31.0, -7.7, 1e-3, 99.0});
      requireBatchOfSinglePoints(c.curve, {0.0, 0.37, -1.5, 1e6, 1e308, -1e5, 0.1, 3.0});
      writeBatchEvaluator(*compileFormula(formula, "fuzz"), "evaluateFuzz");
    }
    for (const double x : {0.0, 0.37, -1.5, 1e6, 1e308}) {
      if (c.kind == ConstraintKind::Curve) evaluate(c.curve, x);
      else evaluate(c.surface, x, -x);
    }
    writeEvaluator(*compileFormula(formula, "fuzz"), "evaluateFuzz");
    writeDynamicsCode(*compileFormula(formula, "fuzz"), "fuzz", {0.3});
  } catch (const FaultError& e) {
    if (std::string_view(e.what()).empty()) throw std::logic_error("a refusal without words");
  }
}

}  // namespace reachlab::constraints
