#pragma once
#include <optional>

#include "base/ticks.h"
#include "bench/contender.h"

namespace reachlab::bench {

/// The scene computed by code written for it alone: everything inlined, every size a constant, nothing that could be configured. What a
/// plant compiled from an experiment is compared with. Method name `limit`; empty where no such form is kept (S5, S5h, S7c).
std::optional<Contender> makeLimit(const BenchScene& scene);

Contender makeExactLimit(const BenchScene& scene);      // S1, S7a, S7b: dense matrix
Contender makeModalLimit(const BenchScene& scene);      // S1b50, S1b500: modes
Contender makeMultistepLimit(const BenchScene& scene);  // S2a, S2b, S3, S4, S7f, S8: Adams-Bashforth-Moulton of order 6
Contender makeSmallLimit(const BenchScene& scene);      // S6: RK4; S7d, S7e: RK4 in Cartesian coordinates

/// Steps a form through a reach: Form has `start(scene)`, `step(segment)`, `state(double*)`, `positions(double*)`, kStates, kMasses.
template <class Form>
Contender makeLimitContender(const BenchScene& scene, const Form& form) {
  const auto shared = std::make_shared<const Form>(form);
  const Segments segments = makeSegments(scene, kTickSeconds);
  Contender out;
  out.method = "limit";
  out.run = [shared, segments](Trajectory* trajectory) {
    Form f = *shared;
    const auto sample = [&] {
      std::vector<double> y(Form::kStates), r(3 * Form::kMasses);
      f.state(y.data());
      f.positions(r.data());
      trajectory->states.insert(trajectory->states.end(), y.begin(), y.end());
      trajectory->positions.insert(trajectory->positions.end(), r.begin(), r.end());
    };
    if (!trajectory) {
      for (const dynamics::HandSegment& segment : *segments) f.step(segment);
      consume(f.probe());
      return;
    }
    sample();
    for (std::size_t i = 0; i < segments->size(); ++i) {
      f.step((*segments)[i]);
      if ((i + 1) % kTicksPerSample == 0) sample();
    }
    trajectory->steps = segments->size();
    trajectory->rhsEvaluations = Form::kRhsPerStep * segments->size();
    trajectory->worstTick = Form::kRhsPerStep;
  };
  return out;
}

}  // namespace reachlab::bench
