#include "cli/terminal/every_option.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.h"
#include "sim/experiment/resources.h"
#include "sim/record/log/log.h"
#include "sim/record/log/logs_folder.h"
#include "sim/session/programme.h"
#include "sim/session/session_folder.h"

namespace reachlab::cli {
namespace {

namespace fs = std::filesystem;

bool isLog(const fs::path& path) {
  if (path.filename().string().ends_with(record::kLogEnding)) return true;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  std::array<char, 8> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == "REACHLOG";
}

struct Value {
  std::string option, text;
};

// Texts of the command that was given and of those that it stands in: names, files and folders.
std::vector<Value> givenValues(const CLI::App& app) {
  std::vector<Value> values;
  for (const CLI::App* command = &app;;) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_type_name().find("TEXT") == std::string::npos) continue;
      for (const std::string& text : option->results()) values.push_back({option->get_name(), text});
    }
    if (command->get_subcommands().empty()) return values;
    command = command->get_subcommands().front();
  }
}

// The file behind a name, too.
bool isSameFile(const std::string& output, const std::string& input) {
  std::error_code error;
  if (fs::equivalent(output, input, error)) return true;
  const auto shipped = experiment::shippedExperimentFile(input);
  if (shipped && fs::equivalent(output, *shipped, error)) return true;
  const auto plan = session::findPlan(input);
  return plan && fs::equivalent(output, *plan, error);
}

}  // namespace

void checkOutputs(const CLI::App& app) {
  const std::vector<Value> values = givenValues(app);
  for (const Value& value : values) {
    const auto refuse = [&](const char* what) {
      throw FaultError(
          Fault{value.option, "is " + value.text + ", " + what, "a file or folder elsewhere: recordings and inputs are not written over"});
    };
    const bool isOutput = value.option == "--out" || value.option == "--figure";
    if (!isOutput && value.option != "--backup") continue;
    if (session::liesInSourcedata(value.text)) refuse("which lies in a dataset's sourcedata");
    if (!isOutput) continue;
    if (isLog(value.text)) refuse("which is the name of a recording");
    for (const Value& other : values)
      if (&other != &value && isSameFile(value.text, other.text)) refuse("which this command reads");
  }
}

}  // namespace reachlab::cli
