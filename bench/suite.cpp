#include "bench/suite.h"

#include <algorithm>

#include "base/fault.h"
#include "base/ticks.h"
#include "bench/peers.h"
#include "sim/experiment/checked_experiment.h"

namespace reachlab::bench {
namespace {

struct Setting {
  double step, tolerance;
};

std::vector<Setting> settingsOf(const std::string& method, bool quick) {
  if (quick || method == "auto" || method == "exact") return {{kTickSeconds, 0}};
  if (method == "adaptive")
    return {{kTickSeconds, 0}, {kTickSeconds, 1e-6}, {kTickSeconds, 1e-8}, {kTickSeconds, 1e-10}, {kTickSeconds, 1e-12}};
  if (method == "rk4") return {{1e-3, 0}, {5e-4, 0}, {2.5e-4, 0}, {1e-4, 0}};
  return {{1e-3, 0}, {5e-4, 0}, {2.5e-4, 0}};
}

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

#ifdef REACHLAB_BENCH_PEERS
constexpr bool kPeersBuilt = true;
std::vector<Contender> makePeers(const BenchScene& scene) {
  std::vector<Contender> all = makeOdeintPeers(scene);
  for (Contender& peer : makeCvodePeers(scene)) all.push_back(std::move(peer));
  return all;
}
#else
constexpr bool kPeersBuilt = false;
std::vector<Contender> makePeers(const BenchScene&) { return {}; }
#endif

const std::vector<std::string>& peerNames() {
  static const std::vector<std::string> names{"odeint-rk4", "odeint-dopri5", "odeint-fehlberg78", "cvode-adams", "cvode-bdf"};
  return names;
}

void checkNames(const SuiteOptions& options) {
  std::string allowed;
  for (const auto& list : {experiment::methodNames(), peerNames()})
    for (const std::string& name : list) allowed += (allowed.empty() ? "" : ", ") + name;
  for (const std::string& m : options.methods) {
    if (contains(peerNames(), m) && !kPeersBuilt)
      throw ResourceError("method " + m + " is another library; configure the build with -DREACHLAB_BENCH_PEERS=ON to measure it");
    if (!contains(experiment::methodNames(), m) && !contains(peerNames(), m)) throw FaultError(Fault{"method", "is " + m, allowed});
  }
}

}  // namespace

std::vector<Row> runSuite(const SuiteOptions& options, const std::function<void(const std::string&)>& progress,
                          std::vector<std::string>& refusals) {
  checkNames(options);
  std::vector<BenchScene> scenes;
  if (options.scenes.empty()) scenes = benchScenes();
  for (const std::string& name : options.scenes) scenes.push_back(benchScene(name));
  const auto wanted = [&](const std::string& method) { return options.methods.empty() || contains(options.methods, method); };

  std::vector<Row> all;
  for (const BenchScene& scene : scenes) {
    progress(scene.name + ": " + scene.title);
    std::vector<Contender> contenders;
    for (const std::string& method : experiment::methodNames()) {
      if (!wanted(method)) continue;
      for (const Setting& s : settingsOf(method, options.quick)) {
        try {
          contenders.push_back(makePlantContender(scene, method, s.step, s.tolerance));
        } catch (const Error& e) {
          refusals.push_back(scene.name + " " + method + ": " + e.what());
          break;
        }
      }
    }
    for (Contender& peer : makePeers(scene))
      if (wanted(peer.method) && !(options.quick && options.methods.empty())) contenders.push_back(std::move(peer));
    if (contenders.empty()) continue;
    for (Row& row : measure(scene, computeReference(scene), contenders, options.effort)) all.push_back(std::move(row));
  }
  return all;
}

bool isPeer(const Row& row) { return contains(peerNames(), row.method); }

}  // namespace reachlab::bench
