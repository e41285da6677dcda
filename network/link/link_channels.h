#pragma once
#include <vector>

#include "network/coupled_copy.h"
#include "sim/record/configuration/channels.h"

namespace reachlab::network {

/// How a station's copy stands to the others, as channels of a recording: its ledger; of every other station, in their order, how far the
/// two copies are apart, the newest sample's age, fade, synchronisation, round trip and loss. `station`: from 1, of so many.
std::vector<record::Channel> linkChannels(int station, int stations);
/// How many they are with so many peers; so it is also where those of the next peer begin, with how far the copies are apart.
constexpr std::size_t linkColumns(int peers) { return 1 + 6 * static_cast<std::size_t>(peers); }
inline constexpr std::size_t kMostLinkColumns = linkColumns(kMaxStations - 1);
/// What stands in them after a tick, before what came then is taken; NaN: not known.
void fillLinks(const CoupledCopy& copy, double* columns) noexcept;

}  // namespace reachlab::network
