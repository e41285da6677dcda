#pragma once

namespace reachlab::predict {

/// What the search for one minimum may cost. Counted in multiplications, not in time, so that what is refused is the same on every computer.
class WorkLimit {
 public:
  /// Throws RefusedError once all that was spent is more than a prediction may cost.
  void spend(double multiplications);
  /// Throws RefusedError where so many numbers would have to be kept at once.
  static void hold(double numbers);

 private:
  double spent_ = 0;
};

}  // namespace reachlab::predict
