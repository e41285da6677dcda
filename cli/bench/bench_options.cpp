#include "cli/bench/bench_options.h"

namespace reachlab::cli {

void addBenchOptions(CLI::App& command, BenchOptions& options) {
  command.add_option(
      "--scene", options.scenes,
      "Scenes (S1 S1b50 S1b500 S2a S2b S3 S4 S5 S5h S6 S7a S7b S7c S7d S7e S7f S8), or constraint-eval for the computation time of a "
      "constraint's derivatives, or an experiment with --tick (file or shipped name) [default: all]");
  command.add_option("--method", options.methods, "Methods (auto rk4 exact abm adaptive stiff, or a peer if built) [default: all]");
  command.add_option("--rounds", options.rounds, "Timed repetitions, interleaved over the methods")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  command.add_flag("--quick", options.quick, "1 ms and the default tolerance only, no peers unless named");
  command.add_flag("--sampled", options.sampled, "Instead: what a hand costs that comes as samples at 1 kHz, clean, noisy and quantised");
  command.add_flag("--tick", options.tick,
                   "Instead: what a tick costs from the device's sample to the force, without the device, as percentiles");
  command.add_option("--ticks", options.ticks, "Ticks of each scene for --tick")
      ->check(CLI::Range(1000, 100'000'000))
      ->capture_default_str();
  command.add_flag("--network", options.network,
                   "Instead: how stable stations are: two simulated people move one object over simulated links");
  command.add_option("--setups", options.setups, "Random set-ups of an object for --network; 0: none")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command.add_option("--csv", options.csv, "Write the rows of --network to this file");
  command.add_option("--json", options.json, "Write the rows to this file");
  command.add_option("--svg", options.svg, "Draw computation time against error into this file");
  command.footer(
      "Computation times are nanoseconds of processor time per simulated millisecond (median of the rounds, quartiles beside it). Errors are the\n"
      "largest over samples at 100 Hz, in SI units. Compare computation times within one run only.\n"
      "Examples: reach bench --scene S1 --scene S2a --quick\n"
      "          reach bench --json rows.json --svg work-precision.svg\n"
      "          reach bench --tick --scene S1 --ticks 100000\n"
      "          reach bench --tick --scene centre-out --scene curl-field\n"
      "          reach bench --network --quick --csv network.csv --svg network.svg\n"
      "          reach bench --network --setups 500\n"
      "          reach bench --scene constraint-eval");
}

}  // namespace reachlab::cli
