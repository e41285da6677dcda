#pragma once
#include "bench/contender.h"

namespace reachlab::bench {

/// Libraries that a user could take instead, on the same hand-written right-hand sides (systems.h). Each one gives a result every
/// millisecond and reads the hand as the same prepared polynomial. Step sizes and tolerances are scanned, because nobody knows beforehand
/// which of them meets an error. They exist if the bench was built with -DREACHLAB_BENCH_PEERS=ON.
std::vector<Contender> makeOdeintPeers(const BenchScene& scene);
std::vector<Contender> makeCvodePeers(const BenchScene& scene);

}  // namespace reachlab::bench
