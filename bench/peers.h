#pragma once
#include "base/ticks.h"
#include "bench/contender.h"

namespace reachlab::bench {

/// Libraries that a user could pick instead, on the same hand-written right-hand sides (systems.h), each giving a result every
/// millisecond and getting the hand as the same prepared polynomial. Step sizes and tolerances are scanned, because nobody knows
/// beforehand which one meets an error. Empty unless built with -DREACHLAB_BENCH_PEERS=ON.
std::vector<Contender> makePeers(const BenchScene& scene);
bool peersBuilt();

/// odeint's rk4 at 1 ms: the yardstick that hand-written forms are compared with.
Contender makeOdeintRk4(const BenchScene& scene, double step = kTickSeconds);

}  // namespace reachlab::bench
