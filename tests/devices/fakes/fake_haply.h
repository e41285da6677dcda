#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/vec3.h"

namespace reachlab::test {

/// Haply's Inverse service, played: a websocket on 127.0.0.1 that keeps the published protocol (one state for each message, the first one
/// with the configuration), with a device whose cursor the test moves. What it hears is kept.
class FakeHaply {
 public:
  enum class Speaks {
    AnswersOnly,  // 3.5: nothing unless asked
    GreetsFirst,  // 3.1: its first state unasked
    OldObjects,   // 3.0: devices by name, not in a list
    Garbage,      // no JSON
    NoDevice,     // the service without an Inverse3
    NoWebsocket,  // something else listens on the port
    ClosesAtOnce,
  };
  explicit FakeHaply(Speaks speaks = Speaks::AnswersOnly);
  ~FakeHaply();
  FakeHaply(const FakeHaply&) = delete;
  FakeHaply& operator=(const FakeHaply&) = delete;

  std::uint16_t port() const { return port_; }

  // Its own axes: x right, y away from the user, z up.
  void moveTo(const Vec3& cursor);
  Vec3 lastForce() const;
  std::uint64_t forces() const { return forces_; }
  double largestForce() const { return largest_; }
  /// Named in the messages in the order heard, for the protocol's sake.
  std::vector<std::string> firstMessages() const;

  std::atomic<bool> unplugged{false};  // the device leaves the service's list
  std::atomic<bool> garbles{false};    // answers are no JSON from here on
  std::atomic<bool> silent{false};     // answers no more
  /// The service ends: its connection is closed without a word.
  void end();

 private:
  void run();
  void hear(const std::string& message);
  std::string state(bool first) const;

  Speaks speaks_;
  std::uint16_t port_ = 0;
  mutable std::mutex mutex_;
  Vec3 cursor_, force_;
  std::vector<std::string> heard_;
  std::atomic<std::uint64_t> forces_{0};
  std::atomic<double> largest_{0};
  std::atomic<bool> ending_{false};
  std::atomic<int> listener_{-1}, connection_{-1};
  std::thread thread_;
};

}  // namespace reachlab::test
