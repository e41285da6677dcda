#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace reachlab::network {

inline double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// Data about the link in a peer's sample: its number and its departure by the peer's clock. It also names a sample of ours that the peer
/// heard: its departure by our clock and its arrival by the peer's. [ns]. Ours is 0 if the peer has heard no sample.
struct Echo {
  std::uint32_t number = 0;
  std::int64_t left = 0, oursLeft = 0, oursCame = 0;
};

/// One peer's link, computed from the echoes in its samples. Round trip and clock follow NTP (RFC 5905, section 8). A sample of the last
/// second counts as missing if it was lost, or dropped because a newer sample came earlier. One thread.
class PeerClock {
 public:
  void add(const Echo& echo, std::int64_t nowNs) {
    if (echoHeard != 0) longest_ = std::max(longest_, seconds(nowNs - echoHeard));
    echoSent = echo.left;
    echoHeard = nowNs;
    if (echo.oursLeft != 0) {
      EchoTrip& e = exchanges_[at_++ % kExchanges];
      e.roundTrip = seconds((nowNs - echo.oursLeft) - (echo.left - echo.oursCame));
      e.offset = 0.5 * (seconds(echo.oursCame - echo.oursLeft) + seconds(echo.left - nowNs));
      judge();
    }
    if (firstSeq_ == 0 || echo.number < lastSeq_) firstSeq_ = lastSeq_ = echo.number, came_ = 0, sinceNs_ = nowNs;
    if (echo.number > lastSeq_) stride_ = std::min(stride_, echo.number - lastSeq_);  // not every tick need be sent
    lastSeq_ = echo.number;
    ++came_;
    if (nowNs - sinceNs_ < 1'000'000'000) return;
    const double expected = static_cast<double>(lastSeq_ - firstSeq_) / (stride_ == kNoStride ? 1 : stride_) + 1;
    missing = std::max(0.0, 1 - static_cast<double>(came_) / expected);
    gap = longest_;
    firstSeq_ = lastSeq_ + (stride_ == kNoStride ? 1 : stride_), came_ = 0, sinceNs_ = nowNs, longest_ = 0, stride_ = kNoStride;
  }
  double roundTrip = -1, jitter = 0, missing = 0, gap = 0;  // [s] below 0: not known, [s] SD, share, [s] the longest without a sample
  double offset = 0;                                        // [s] how far the peer's clock is ahead of ours
  std::int64_t echoSent = 0, echoHeard = 0;                 // [ns]

 private:
  static constexpr std::size_t kExchanges = 128;
  struct EchoTrip {
    double roundTrip = 0, offset = 0;
  };
  // The fastest exchange has the least difference between its two directions.
  void judge() {
    const std::size_t known = std::min(at_, kExchanges);
    const EchoTrip* fastest = &exchanges_[0];
    double sum = 0, squares = 0;
    for (std::size_t i = 0; i < known; ++i) {
      const EchoTrip& e = exchanges_[i];
      sum += e.roundTrip, squares += e.roundTrip * e.roundTrip;
      if (e.roundTrip < fastest->roundTrip) fastest = &e;
    }
    const double mean = sum / static_cast<double>(known);
    roundTrip = exchanges_[(at_ - 1) % kExchanges].roundTrip;
    jitter = std::sqrt(std::max(0.0, squares / static_cast<double>(known) - mean * mean));
    offset = fastest->offset;
  }
  std::array<EchoTrip, kExchanges> exchanges_{};
  std::size_t at_ = 0;
  static constexpr std::uint32_t kNoStride = 0xffffffff;
  std::uint32_t firstSeq_ = 0, lastSeq_ = 0, stride_ = kNoStride;
  std::uint64_t came_ = 0;
  std::int64_t sinceNs_ = 0;
  double longest_ = 0;  // [s]
};

}  // namespace reachlab::network
