#include <cctype>
#include <clocale>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/standard_streams.h"
#include "cli/stop_signals.h"
#include "base/error.h"
#include "base/names.h"
#include "base/os.h"

namespace {

/// No option takes "nan" or "inf" for a number: what reads like a default would be recorded.
void refuseNonFinite(CLI::App& command) {
  const CLI::Validator finite(
      [](std::string& text) {
        std::string word;
        for (const char c : text)
          if (c != '+' && c != '-') word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return word.starts_with("nan") || word.starts_with("inf") ? "is " + text + "; allowed: a finite number" : std::string();
      },
      "");
  for (CLI::Option* option : command.get_options())
    if (option->get_type_name().find("FLOAT") != std::string::npos) option->check(finite);
}

/// "; --sede: did you mean --seed?" for the first word that no command knows; empty when nothing is near.
std::string proposal(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  for (const std::string& word : app.remaining(true)) {
    std::vector<std::string> known;
    if (word.starts_with("--")) {
      for (const CLI::Option* option : command->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    } else {
      for (const CLI::App* other : command->get_subcommands({})) known.push_back(other->get_name());
    }
    const std::string nearest = reachlab::nearestName(word.substr(0, word.find('=')), known);
    if (!nearest.empty()) return "; " + word + ": did you mean " + nearest + "?";
  }
  return {};
}

int run(int argc, char** argv) {
  using namespace reachlab;
  using namespace reachlab::cli;
  int exitCode = 0;
  CLI::App app{"reach: reaching experiments without a window", "reach"};
  app.set_version_flag("--version", "reach " REACHLAB_VERSION);
  app.require_subcommand(1);
  app.footer("Example: reach run chain-moderate --device simulated --trials 20 --seed 1 --fast");
  for (auto* add : {addListCommand, addValidateCommand, addRunCommand, addSimulateCommand, addPredictCommand, addAnalyzeCommand,
                    addReplayCommand, addExportCommand, addRecoverCommand, addConstraintCommand, addBenchCommand})
    add(app, exitCode);
  for (CLI::App* command : app.get_subcommands({})) refuseNonFinite(*command);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "reach: %s%s\n", e.what(), proposal(app).c_str());
    return 2;
  } catch (const UsageError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const ResourceError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  } catch (const RefusedError& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 4;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "reach: %s\n", e.what());
    return 3;
  }
  return exitCode;
}

}  // namespace

int main(int argc, char** argv) {
  reachlab::os::holdStandardDescriptors();
  reachlab::cli::guardStandardStreams();
  reachlab::cli::endOnSignals();
  return reachlab::cli::finishStandardOutput(run(argc, argv));
}
