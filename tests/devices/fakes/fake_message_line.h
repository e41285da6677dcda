#pragma once
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "devices/driver/message_link.h"
#include "devices/io/polled_device.h"

namespace reachlab::test {

/// A line to a device without one: what was sent, what waits to be received, and what goes wrong.
struct FakeMessageLine {
  std::vector<std::string> sent;
  std::deque<std::string> waiting;
  std::vector<int> waits;  // [ms] of each receiving
  bool gone = false;       // nothing comes any more
  bool deaf = false;       // nothing can be sent
  bool closed = false;     // it cannot be opened; for the test's own opener
  std::string fault;
};

struct FakeMessageLink final : devices::MessageLink {
  explicit FakeMessageLink(std::shared_ptr<FakeMessageLine> l) : line(std::move(l)) {}
  bool send(std::string_view message) noexcept override {
    if (line->deaf) return false;
    line->sent.emplace_back(message);
    return true;
  }
  Got receive(std::string& message, int milliseconds) noexcept override {
    line->waits.push_back(milliseconds);
    if (line->gone) return Got::Gone;
    if (line->waiting.empty()) return Got::Nothing;
    message = line->waiting.front();
    line->waiting.pop_front();
    return Got::Message;
  }
  std::string fault() const override { return line->fault; }
  std::shared_ptr<FakeMessageLine> line;
};

/// A force that stands, and a clock that the test sets.
struct StandingForce final : devices::ForceSource {
  StandingForce(const Vec3& f = {}) : force(f) {}
  Vec3 force;
  std::int64_t ns = 0;
  Vec3 newest() noexcept override { return force; }
  std::int64_t now() const noexcept override { return ns; }
};

}  // namespace reachlab::test
