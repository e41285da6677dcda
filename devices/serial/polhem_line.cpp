#include "devices/serial/polhem_line.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace reachlab::devices {

std::optional<PolhemState> readPolhemLine(std::string_view line) noexcept {
  constexpr int kNumbers = 8;
  constexpr double kFarthest = 1;  // [m]
  double numbers[kNumbers] = {};
  const char *at = line.data(), *const end = at + line.size();
  for (double& number : numbers) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number) || (next != end && *next != ' ' && *next != '\r')) return std::nullopt;
    at = next;
  }
  while (at != end && (*at == ' ' || *at == '\r')) ++at;
  PolhemState state;
  state.place = 1e-3 * Vec3{numbers[0], numbers[1], numbers[2]};
  if (at != end || norm(state.place) > kFarthest || std::abs(numbers[7]) > 1e6) return std::nullopt;
  state.info = static_cast<int>(numbers[7]);
  return state;
}

std::string polhemForceLine(const Vec3& force) {
  constexpr double kMost = 32.767;  // [N]
  Vec3 f = isFinite(force) ? force : Vec3{};
  if (const double size = norm(f); size > kMost) f *= kMost / size;
  const auto milli = [](double newtons) { return static_cast<int>(std::lround(1e3 * newtons)); };
  return fmt::format("{:<{}}\n", fmt::format("{} {} {} 2 0 0 0", milli(f.x), milli(f.y), milli(f.z)), kPolhemLineBytes - 1);
}

}  // namespace reachlab::devices
