#pragma once
#include <string>
#include <vector>

namespace reachlab::cli {

/// Time of one evaluation of r and all its derivatives (`reach bench --scene constraint-eval`).
struct ConstraintEvalRow {
  std::string constraint;  // torus | epitrochoid | monkey-saddle
  std::string form;        // hand-written, generated, typed; generated-x8, typed-x8: of eight points of a curve together
  double nsPerEval = 0;    // [ns] of the processor, median of `repetitions`, the forms measured in turns
  double apart = 0;        // most of any component of r and its derivatives beside the hand-written form's [m]
};

/// Measures all of them, about a second. The three forms share flags, call and sine. They differ only in the code between.
std::vector<ConstraintEvalRow> benchConstraintEval(int repetitions = 25);

}  // namespace reachlab::cli
