#pragma once
#include <string>
#include <vector>

namespace reachlab::dynamics {

/// The method that `method: auto` chose, and the reason. The program shows it before the trial and stores it in the recording.
struct MethodChoice {
  std::string method;         // rk4 | exact | abm | adaptive | stiff
  std::string form;           // "line, 10 states" / "curve in phi" / "surface in ambient coordinates" …
  std::string reason;         // one sentence with the numbers
  double fastestMode = 0;     // [1/s] largest |eigenvalue| at the start
  double predictedError = 0;  // [m] position, over one reach
  std::vector<std::string> warnings;
};

}  // namespace reachlab::dynamics
