#pragma once

namespace reachlab::haptics {

/// A virtual hand that does not use HapticDevice::see. The engine need not observe masses for it.
class BlindHand {
 public:
  virtual ~BlindHand() = default;
};

}  // namespace reachlab::haptics
