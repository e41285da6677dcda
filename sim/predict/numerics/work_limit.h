#pragma once

namespace reachlab::predict {

/// Limit of the work of one search for a minimum. It counts multiplications instead of time, so that every computer refuses the same
/// searches.
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
