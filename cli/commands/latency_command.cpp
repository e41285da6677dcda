#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/commands.h"
#include "cli/output/json_text.h"
#include "devices/driver/registry.h"
#include "devices/clock_timing.h"

namespace reachlab::cli {
namespace {

struct LatencyRequest {
  std::string device;
  double seconds = 5;
  bool json = false;
};

// A bare word that is no kind of device is a PHANToM's name, as before there were others.
std::string deviceOf(const std::string& asked) {
  const std::string kind = asked.substr(0, asked.find_first_of(":,"));
  if (devices::findDriver(kind) != nullptr) return asked;
  return asked.empty() ? "phantom" : "phantom:" + asked;
}

void compare(const LatencyRequest& r) {
  const auto rows = devices::measureLatency(deviceOf(r.device), r.seconds);
  if (r.json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& row : rows)
      list.push_back({{"clock", row.clock},
                      {"ticks_per_s", row.rate},
                      {"ticks", row.ticks},
                      {"missed", row.missed},
                      {"jitter_p50_s", row.jitterP50},
                      {"jitter_p99_s", row.jitterP99},
                      {"jitter_max_s", row.jitterMax},
                      {"latency_p50_s", row.ageP50},
                      {"latency_p99_s", row.ageP99},
                      {"latency_max_s", row.ageMax}});
    fmt::print("{}", jsonText(list));
    return;
  }
  fmt::print("{:<10} {:>8} {:>7} {:>27} {:>27}\n", "clock", "ticks/s", "missed", "jitter us p50/p99/max", "latency us p50/p99/max");
  for (const auto& row : rows)
    fmt::print("{:<10} {:>8.1f} {:>7} {:>27} {:>27}\n", row.clock, row.rate, row.missed,
               fmt::format("{:.0f} / {:.0f} / {:.0f}", row.jitterP50 * 1e6, row.jitterP99 * 1e6, row.jitterMax * 1e6),
               fmt::format("{:.0f} / {:.0f} / {:.0f}", row.ageP50 * 1e6, row.ageP99 * 1e6, row.ageMax * 1e6));
}

}  // namespace

void addLatencyCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("latency", "Measures how regularly a device is served and how old its samples are");
  const auto r = std::make_shared<LatencyRequest>();
  command->add_option("device", r->device,
                      "As for `reach run`: forcedimension:0, mouse …; another word is a PHANToM's name [default: phantom]");
  command->add_option("--seconds", r->seconds, "How long each is measured [default: 5 s]")->check(CLI::Range(0.1, 3600.0));
  command->add_flag("--json", r->json, "an array of objects");
  command->footer(
      "Jitter: how far two ticks are from 1 ms apart. Latency: from a sample to the force that was computed from it. No force is rendered\n"
      "meanwhile. A PHANToM is measured by both clocks, its scheduler's and the computer's, with the force in effect. Other devices have\n"
      "one row. A latency of 0 means that the device does not tell when its samples were taken.\n\n"
      "Examples:\n  reach latency\n  reach latency forcedimension:0 --seconds 60");
  command->callback([r] { compare(*r); });
}

}  // namespace reachlab::cli
