#include "bench/peers.h"

namespace reachlab::bench {

#ifdef REACHLAB_BENCH_PEERS
std::vector<Contender> makeOdeintPeers(const BenchScene& scene);
std::vector<Contender> makeCvodePeers(const BenchScene& scene);

bool peersBuilt() { return true; }

std::vector<Contender> makePeers(const BenchScene& scene) {
  std::vector<Contender> all = makeOdeintPeers(scene);
  for (Contender& c : makeCvodePeers(scene)) all.push_back(std::move(c));
  return all;
}
#else
bool peersBuilt() { return false; }
std::vector<Contender> makePeers(const BenchScene&) { return {}; }
#endif

}  // namespace reachlab::bench
