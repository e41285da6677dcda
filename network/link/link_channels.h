#pragma once
#include <vector>

#include "network/coupled_copy.h"
#include "sim/record/configuration/channels.h"

namespace reachlab::network {

/// The relation of a station's copy to the other copies, as channels of a recording. The first channel is its ledger. For every other
/// station follow, in their order: distance of the two copies, age of the newest sample, fade, synchronisation, round trip and loss.
/// `station` counts from 1, up to the number of stations.
std::vector<record::Channel> linkChannels(int station, int stations);
/// The number of channels with this many peers. It is also the index of the next peer's first channel, the distance of the copies.
constexpr std::size_t linkColumns(int peers) { return 1 + 6 * static_cast<std::size_t>(peers); }
inline constexpr std::size_t kMostLinkColumns = linkColumns(kMaxStations - 1);
/// The values of the channels after a tick, before the new samples are taken. NaN: not known.
void fillLinks(const CoupledCopy& copy, double* columns) noexcept;

}  // namespace reachlab::network
