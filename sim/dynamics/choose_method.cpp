#include "sim/dynamics/choose_method.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sim/dynamics/object/stability.h"

namespace reachlab::dynamics {
namespace {

constexpr double kMultistepReach = 0.3;  // |eigenvalue| times step up to which order 7 in one step a tick is accurate and stable
constexpr double kExplicitReach = 100;   // up to which sub-steps of an explicit pair keep well below the cap of a tick
constexpr double kRefusedReach = 450;    // beyond which they exceed it
constexpr int kMaxStiff = 24;            // masses of the L-stable method's dense systems

void requireRk4(const std::vector<std::complex<double>>& eigenvalues, MethodChoice& choice, const SceneFacts& facts) {
  choice.predictedError = predictRk4Error(eigenvalues, facts.step, facts.length, facts.duration);
  if (!isRk4Stable(eigenvalues, facts.step)) {
    double worst = 0;
    std::complex<double> z;
    for (const auto& value : eigenvalues)
      if (const double growth = rk4Amplification(value * facts.step); growth > worst) worst = growth, z = value * facts.step;
    const bool real = std::abs(z.real()) > std::abs(z.imag());
    throw RefusedError(
        fmt::format("method rk4 is unstable here: the fastest mode times the step is {:.4g}, its limit {:.4g} ({}), and every step "
                    "multiplies that mode by {:.4g}; "
                    "use method auto, or a step below {:.3g} s",
                    std::abs(z), real ? kRk4RealLimit : kRk4ImaginaryLimit,
                    real ? "a real mode: light mass, strong damper" : "an undamped mode", worst, findRk4StepLimit(eigenvalues)));
  }
  if (facts.hardCurve)
    choice.warnings.push_back("rk4 at a fixed step cannot follow a curve through places where |r_phi| is small; use method auto");
}

}  // namespace

MethodChoice chooseMethod(const std::string& asked, const ObjectModel& model, const SceneFacts& facts) {
  const std::vector<std::complex<double>> eigenvalues = computeEigenvalues(model);
  MethodChoice choice;
  for (const auto& value : eigenvalues) choice.fastestMode = std::max(choice.fastestMode, std::abs(value));
  const double reach = choice.fastestMode * facts.step;
  const std::string numbers = fmt::format("fastest mode {:.4g} 1/s, times step {:.3g}", choice.fastestMode, reach);

  if (asked == "auto" || asked.empty()) {
    if (facts.linear && !facts.elasticEnds) {
      choice.method = "exact";
      choice.reason = "linear with constant coefficients: the matrix exponential is exact for any stiffness and damping (" + numbers + ")";
    } else if (facts.elasticEnds || reach > kMultistepReach) {
      choice.method = reach > kExplicitReach && model.count() <= kMaxStiff ? "stiff" : "adaptive";
      choice.reason = numbers + (facts.elasticEnds ? "; the ends are elastic, which the exact propagator does not know" : "") +
                      (choice.method == "stiff"
                           ? fmt::format(": beyond {} only an L-stable method is affordable", kExplicitReach)
                           : fmt::format(": sub-steps of an embedded pair of order 8 (one step a tick up to {})", kMultistepReach));
    } else {
      choice.method = "abm";
      choice.reason =
          numbers +
          fmt::format(
              ": within {}, Adams-Bashforth-Moulton of order 7 in one step a tick; ticks whose error estimate is too large are done by {}",
              kMultistepReach, facts.hardCurve ? "sub-steps in a fictitious time, which passes cusps" : "an embedded pair of order 8");
    }
  } else {
    choice.method = asked;
    choice.reason = "asked for; " + numbers;
  }

  if (choice.method == "exact") {
    if (!facts.linear)
      throw RefusedError(
          "method exact is for linear scenes (a straight line, free space without rotation); use auto, abm or adaptive here");
    if (facts.elasticEnds) throw RefusedError("method exact does not know elastic ends; use auto or adaptive here");
    choice.predictedError = 1e-14;
  } else if (choice.method == "rk4") {
    requireRk4(eigenvalues, choice, facts);
  } else if (choice.method == "stiff") {
    if (model.count() > kMaxStiff)
      throw RefusedError(fmt::format("method stiff solves dense systems for up to {} masses, and here are {}; use auto, or fewer masses",
                                     kMaxStiff, model.count()));
    if (facts.hardCurve)
      choice.warnings.push_back(
          fmt::format("method stiff cannot pass places where |r_phi| is small, and a trial that meets one ends with `computation`; method "
                      "adaptive passes them with an object whose fastest mode times step is {} or less (here {:.3g})",
                      kRefusedReach, reach));
    choice.predictedError = 1e-9;
  } else {
    if (choice.method != "abm" && choice.method != "adaptive")
      throw RefusedError("there is no method '" + choice.method + "'; allowed: auto, rk4, exact, abm, adaptive, stiff");
    if (reach > kRefusedReach)
      throw RefusedError(
          fmt::format("method {} would need more than 1000 right-hand sides a tick: fastest mode times step {:.4g}, limit {}; use {}, or a "
                      "smaller step",
                      choice.method, reach, kRefusedReach,
                      facts.linear                 ? "method exact"
                      : model.count() <= kMaxStiff ? "method stiff"
                                                   : fmt::format("method stiff with at most {} masses", kMaxStiff)));
    choice.predictedError = 1e-11;
  }
  return choice;
}

}  // namespace reachlab::dynamics
