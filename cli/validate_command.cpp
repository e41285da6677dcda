#include <fmt/format.h>

#include "cli/commands.h"
#include "constraints/definition.h"
#include "constraints/error.h"
#include "constraints/json_reader.h"
#include "sim/experiment/experiment.h"
#include "sim/session/plan.h"

namespace reachlab {
namespace {

// What a file is shows in its keys; a file that shows nothing is read as an experiment, whose faults then say what is missing.
void validateFile(const std::string& file) {
  const std::string text = readTextFile(file);
  const JsonNode tree = parseJson(text, file);
  if (tree.find("blocks") != nullptr || tree.find("order_seed") != nullptr) {
    std::string faults;
    for (const std::string& fault : planProblems(file)) faults += (faults.empty() ? "" : "\n") + fault;
    if (!faults.empty()) throw UsageError(faults);
  } else if (tree.find("curve") != nullptr || tree.find("surface") != nullptr) {
    parseDefinition(text, file);
  } else {
    parseExperiment(text, file);
  }
}

}  // namespace

void addValidateCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("validate", "Check experiment files, constraint definitions and session plans");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("files", *files, "files to check; every fault of every file is named at once")->required();
  command->footer("Examples:\n  reach validate my-experiment.json\n  reach validate *.json");
  command->callback([files, &exitCode] {
    for (const std::string& file : *files) {
      try {
        validateFile(file);
        fmt::print("{}: fine\n", file);
      } catch (const UsageError& e) {
        fmt::print(stderr, "{}\n", e.what());
        exitCode = 2;
      }
    }
  });
}

}  // namespace reachlab
