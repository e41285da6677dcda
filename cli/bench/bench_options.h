#pragma once
#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace reachlab::cli {

/// The options of `reach bench`. `reach` and the program that measures read the same options by the same definition.
struct BenchOptions {
  std::vector<std::string> scenes, methods;  // empty: all
  int rounds = 7;
  bool quick = false, sampled = false, tick = false, network = false;
  std::uint64_t ticks = 1'000'000;
  int setups = 40;             // random ones of the network study
  std::string json, svg, csv;  // files; empty: none
};

inline constexpr const char* kBenchProgram = "reachlab-bench";
inline constexpr const char* kBenchSummary =
    "Sets speed against error: scenes S1 to S8, every method, against references of over 20 digits";

/// Puts the options and the footer on `command`. Parsed values end in `options`, which must outlive it.
void addBenchOptions(CLI::App& command, BenchOptions& options);

/// Carries out the benchmarks of `options` and prints the results, in the program that measures alone. Throws reachlab::Error for a fault.
void runBench(const BenchOptions& options);

}  // namespace reachlab::cli
