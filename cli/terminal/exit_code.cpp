#include "cli/terminal/exit_code.h"

#include <cstdio>
#include <string>
#include <vector>

#include "base/fault.h"
#include "base/names.h"
#include "base/system/error_report.h"
#include "cli/terminal/option_words.h"
#include "sim/session/recorded_run.h"

namespace reachlab::cli {
namespace {

const CLI::App& givenCommand(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

/// The first thing that the command needs and was not given, with what it says of itself; a command without its word lists them.
std::string missing(const CLI::App& app) {
  const CLI::App& command = givenCommand(app);
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->empty())
      return command.get_name() + ": " + option->get_name() + " is missing: " + option->get_description();
  std::string words;
  for (const CLI::App* word : command.get_subcommands({})) words += (words.empty() ? "" : ", ") + word->get_name();
  const std::vector<std::string> given = app.remaining(true);
  const std::string what =
      given.empty() || given.front().starts_with('-') ? "a command is missing: " : given.front() + " is not a command; commands are ";
  return (&command == &app ? std::string() : command.get_name() + ": ") + what + words + "; --help tells what they do";
}

/// "; --sede: did you mean --seed?" for the first word that no command knows; empty when nothing is near.
std::string proposal(const CLI::App& app) {
  const CLI::App* command = &givenCommand(app);
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

}  // namespace

int exitCodeOf(CLI::App& app, const std::function<int()>& work) {
  try {
    return work();
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::RequiredError&) {
    std::fprintf(stderr, "reach: %s%s\n", missing(app).c_str(), proposal(app).c_str());
    return 2;
  } catch (const CLI::ExtrasError&) {
    std::string words;
    for (const std::string& word : app.remaining(true)) words += (words.empty() ? "" : " ") + word;
    std::fprintf(stderr, "reach: not known here: %s%s\n", words.c_str(), proposal(app).c_str());
    return 2;
  } catch (const CLI::ParseError& e) {
    std::fprintf(stderr, "reach: %s%s\n", e.what(), proposal(app).c_str());
    return 2;
  } catch (const FaultError& e) {
    std::fprintf(stderr, "%s\n", toText(inOptionWords(e.faults)).c_str());
    return 2;
  } catch (const session::DatasetError& e) {
    std::fprintf(stderr, "%s: %s\n", optionOf("data").c_str(), e.what());
    return 3;
  } catch (const std::exception& e) {
    const ErrorReport report = errorReportOf(e);
    const bool own = dynamic_cast<const Error*>(&e) != nullptr;
    std::fprintf(stderr, "%s%s\n", own ? "" : "reach: ", report.sentence.c_str());
    return report.exitCode;
  }
}

}  // namespace reachlab::cli
