#include "network/link/link_channels.h"

#include <fmt/format.h>

#include <limits>

#include "sim/record/configuration/run_configuration.h"

namespace reachlab::network {

std::vector<record::Channel> linkChannels(int station, int stations) {
  std::vector<record::Channel> channels;
  const auto add = [&](const std::string& name, const char* units, const char* columnUnit, const std::string& description) {
    channels.push_back({name, "n/a", "MISC", "n/a", units, description, name + columnUnit});
  };
  const std::string here = fmt::format("{}{}", record::kFurtherName, station);
  add(here + "_ledger", "J", "_j", "what the hands have put in, as far as this station knows, less what its copy of the object holds");
  for (int other = 1; other <= stations; ++other) {
    if (other == station) continue;
    const std::string link = fmt::format("{}_of_{}_", here, other), of = fmt::format("station {}'s newest sample", other);
    add(link + "apart", "m", "_m", "this station's copy and the other's at the moment of " + of + ", root mean square over the masses");
    add(link + "age", "s", "_s", "age of " + of);
    add(link + "fade", "n/a", "", fmt::format("1 while station {}'s hand is held, 0 when it is let go", other));
    add(link + "synchronisation", "rad/s", "_rad_per_s", fmt::format("rate at which this copy is drawn to station {}'s", other));
    add(link + "round_trip", "s", "_s", "there and back, filtered over a second");
    add(link + "loss", "n/a", "",
        fmt::format("share of station {}'s samples of the latest whole second that were not used: lost, or overtaken", other));
  }
  return channels;
}

void fillLinks(const CoupledCopy& copy, double* columns) noexcept {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  *columns++ = copy.ledger();
  for (int i = 0; i < copy.peerCount(); ++i) {
    const PeerLink& link = copy.link(i);
    const double round = link.roundTrip > 0 ? link.roundTrip : kUnknown, loss = link.loss >= 0 ? link.loss : kUnknown;
    for (const double value : {link.heard ? link.apart : kUnknown, link.age, link.fade, link.frequency, round, loss}) *columns++ = value;
  }
}

}  // namespace reachlab::network
