#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/system/helper_program.h"
#include "cli/bench/bench_options.h"
#include "cli/commands/commands.h"

namespace reachlab::cli {
namespace {

/// The options as they were given: parsed here, so that a fault is said before anything starts, and read again by the program.
std::vector<std::string> wordsOf(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = "--" + option->get_lnames().front();
    for (const std::string& value : option->results()) words.push_back(option->get_items_expected_max() == 0 ? name : name + "=" + value);
  }
  return words;
}

}  // namespace

void addBenchCommand(CLI::App& app, int&) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = app.add_subcommand("bench", kBenchSummary);
  addBenchOptions(*command, *options);
  command->callback([options, command] {
    const std::string program = findHelperProgram(kBenchProgram, "reach bench", "the program that measures");
    std::vector<std::string> words = wordsOf(*command);
    std::vector<char*> arguments{const_cast<char*>(program.c_str())};
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    throw ResourceError(fmt::format("reach bench: {} can't be started: {}", program, std::strerror(errno)));
  });
}

}  // namespace reachlab::cli
