#pragma once

namespace reachlab::haptics {

/// A virtual hand that looks at nothing (HapticDevice::see): what it does not see need not be observed for it.
class BlindHand {
 public:
  virtual ~BlindHand() = default;
};

}  // namespace reachlab::haptics
