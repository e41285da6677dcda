#include <fmt/format.h>

#include <cstdio>
#include <cstring>

#include "base/error.h"
#include "base/ticks.h"
#include "bench/peers.h"
#include "bench/suite.h"
#include "tests/bench/limit_forms.h"

// limit_bench [SCENE…]: in one run, the form written by hand for a scene alone, odeint's rk4 at 1 ms (the yardstick), and the plant that
// `auto` gives. Prices in ns per simulated millisecond, and the two ratios that the documentation quotes.
int main(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::bench;
  fmt::print("{:<7} {:>9} {:>9} {:>11} {:>9} {:>10} {:>10} {:>11} {:>13}\n", "scene", "state", "limit_ns", "odeint_rk4", "auto_ns",
             "auto_state", "quartiles", "limit/rk4", "auto/limit");
  for (const BenchScene& scene : benchScenes()) {
    bool wanted = argc < 2;
    for (int i = 1; i < argc; ++i) wanted |= scene.name == argv[i];
    const std::optional<Contender> limit = makeLimit(scene);
    if (!wanted || !limit) continue;
    std::vector<Contender> contenders{*limit, makeOdeintRk4(scene)};
    try {
      contenders.push_back(makePlantContender(scene, "auto", kTickSeconds, 0));
    } catch (const Error& e) {
      fmt::print(stderr, "{}: auto refused: {}\n", scene.name, e.what());
    }
    const std::vector<Row> rows = measure(scene, computeReference(scene), contenders, {.rounds = 15, .secondsPerRound = 3e-3});
    const double l = rows[0].nsPerMs, o = rows[1].nsPerMs, a = rows.size() > 2 ? rows[2].nsPerMs : 0;
    fmt::print("{:<7} {:>9.1e} {:>9.1f} {:>11.1f} {:>9.1f} {:>10.1e} {:>10} {:>11.2f} {:>13.2f}\n", scene.name, rows[0].error.state, l, o,
               a, rows.size() > 2 ? rows[2].error.state : 0.0, fmt::format("{:.0f}-{:.0f}", rows[0].nsLow, rows[0].nsHigh), l / o, a / l);
    std::fflush(stdout);
  }
}
