#pragma once
#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/math/vec3.h"

namespace reachlab::test {

/// Haply's Inverse service, played: a websocket on 127.0.0.1 that keeps the published protocol (one state of every device for each message,
/// the first one with the configuration; any number of clients), with devices whose cursors the test moves, and a grip for each. What it
/// hears is kept.
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
  static constexpr const char* kFirst = "049D";
  explicit FakeHaply(Speaks speaks = Speaks::AnswersOnly, const std::vector<std::string>& ids = {kFirst});
  ~FakeHaply();
  FakeHaply(const FakeHaply&) = delete;
  FakeHaply& operator=(const FakeHaply&) = delete;

  std::uint16_t port() const { return port_; }

  // Its own axes: x right, y away from the user, z up.
  void moveTo(const Vec3& cursor, const std::string& id = kFirst);
  /// Every cursor goes by this law of the time since the service began [s], from now on.
  void moveBy(std::function<Vec3(double)> law);
  Vec3 lastForce(const std::string& id = kFirst) const;
  double largestForce(const std::string& id = kFirst) const;

  /// Whether the device is in the service's list.
  void setPlugged(bool plugged, const std::string& id = kFirst);
  /// The service ends: its connection is closed without a word.
  void end();

 private:
  struct Device {
    std::string id, grip;
    Vec3 cursor, force;
    bool plugged = true;
    double largest = 0;
  };
  void run(std::atomic<bool>& listening);
  void serve(std::shared_ptr<boost::asio::ip::tcp::socket> socket);
  void hear(const std::string& message);
  std::string state(bool first) const;
  const Device& deviceOf(const std::string& id) const;
  Device& deviceOf(const std::string& id) { return const_cast<Device&>(std::as_const(*this).deviceOf(id)); }

  Speaks speaks_;
  std::uint16_t port_ = 0;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  mutable std::mutex mutex_;
  std::vector<Device> devices_;
  std::function<Vec3(double)> law_;
  std::atomic<bool> ending_{false};
  std::atomic<int> listener_{-1};
  std::set<int> connections_;
  std::vector<std::thread> clients_;
  std::thread thread_;
};

}  // namespace reachlab::test
