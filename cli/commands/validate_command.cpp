#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "analysis/study/run_study.h"
#include "base/fault.h"
#include "base/json/json_reader.h"
#include "base/terminal/message.h"
#include "base/text_file.h"
#include "cli/commands/commands.h"
#include "cli/commands/definition_files.h"
#include "cli/output/json_text.h"
#include "cli/terminal/option_words.h"
#include "constraints/catalogue/definition.h"
#include "devices/make_device.h"
#include "devices/preflight/preflight.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/session/session.h"
#include "sim/trial/task_check.h"

namespace reachlab::cli {
namespace {

constexpr const char* kExpected =
    "an experiment file, a constraint definition, a session plan or a study (JSON with comments), or the name of a shipped one";

// The file behind a name, as `reach run` and the constraint commands understand it.
std::string fileOf(const std::string& fileOrName) {
  const bool folder = isFolder(fileOrName);
  if (folder || !isThere(fileOrName))
    if (const auto shipped = experiment::shippedExperimentFile(fileOrName)) return *shipped;
  const auto plan = session::findPlan(fileOrName);
  if (!plan && folder) throw FaultError(fileFault(fileOrName, "is a folder", kExpected));
  return plan.value_or(fileOrName);
}

// A table or a recording would only be told where JSON breaks off.
void checkIsJsonObject(const std::string& text, const std::string& file) {
  const std::size_t at = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (at == std::string::npos || (text[at] != '{' && text[at] != '/'))
    throw FaultError(Fault{{},
                           std::string("is no JSON object") + (file.ends_with(".csv")     ? ", but a table"
                                                               : file.ends_with(".reach") ? ", but a recording"
                                                                                          : ""),
                           kExpected,
                           FilePlace{file, 1, 1}});
}

void warn(const std::vector<Fault>& warnings, const std::string& text, const std::string& file) {
  for (const Fault& warning : atTheirPlaces(warnings, text, file)) fmt::print(stderr, "{}", messageOf(warning, "warning"));
}

// Each warning once, however many targets and blocks it is of.
std::vector<Fault> warningsOf(const session::Programme& programme) {
  std::vector<Fault> warnings;
  for (std::size_t block = 0; block < programme.scenes.size(); ++block)
    for (const session::BlockScene& scene : programme.scenes[block]) {
      const std::string key = scene.kind.empty() ? fmt::format("blocks[{}].experiment", block) : "kinds." + scene.kind;
      for (Fault& warning : inside(key, session::warningsOf(scene.experiment, dynamics::compileScene(scene.experiment).choice)))
        if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(std::move(warning));
    }
  return warnings;
}

bool isStudy(const JsonNode& tree) {
  constexpr std::array kOwn{"subjects", "vary", "measures", "experiment", "plan"};  // in no other file
  return std::any_of(kOwn.begin(), kOwn.end(), [&](const char* key) { return tree.find(key) != nullptr; });
}

// What a file is shows in its keys; a file that shows nothing is read as an experiment, whose faults then say what is missing. Returns what can
// be done with it, if it is an experiment or a plan.
std::optional<session::Programme> validateFile(const std::string& fileOrName) {
  const std::string file = fileOf(fileOrName);
  if (!isThere(file) && file.find('/') == std::string::npos && constraints::findInCatalogue(file) != nullptr) return std::nullopt;
  if (!isThere(file)) experiment::readExperiment(file);  // says which names there are
  const std::string text = readTextFile(file);
  checkIsJsonObject(text, file);
  const JsonNode tree = parseJson(text, file);
  if (tree.find("blocks") != nullptr || tree.find("order_seed") != nullptr) {
    session::Programme programme = session::readProgramme(file);
    warn(warningsOf(programme), text, file);
    return programme;
  } else if (isStudy(tree)) {
    study::checkPoints(study::readDesign(file));
  } else if (tree.find("curve") != nullptr || tree.find("surface") != nullptr) {
    (void)makeAtAllShapes(constraints::parseDefinition(text, file), text, file);
  } else {
    const experiment::CompiledExperiment experiment = experiment::openExperimentText(text, file);
    if (experiment.experiment().task) trial::checkTask(experiment, file);
    session::Programme programme = session::programmeOf(experiment);
    warn(session::warningsOf(experiment, dynamics::compileScene(experiment).choice), text, file);
    return programme;
  }
  return std::nullopt;
}

struct ValidateRequest {
  std::vector<std::string> files;
  std::string device;
  bool json = false;
};

// One line per finding, warnings first.
std::string preflightText(const std::vector<devices::PreflightLine>& lines) {
  std::vector<devices::PreflightLine> ordered = lines;
  std::stable_partition(ordered.begin(), ordered.end(),
                        [](const devices::PreflightLine& line) { return line.verdict == devices::Verdict::Warning; });
  std::string text;
  for (const devices::PreflightLine& line : ordered) text += fmt::format("  {:<8} {}\n", devices::nameOf(line.verdict), describe(line));
  return text;
}

using Json = nlohmann::ordered_json;

std::string preflightJson(const std::vector<devices::PreflightLine>& lines) {
  Json rows = Json::array();
  for (const devices::PreflightLine& line : lines)
    rows.push_back({{"hand", std::max(line.hand, 1)},
                    {"name", line.name},
                    {"verdict", devices::nameOf(line.verdict)},
                    {"asked", line.asked},
                    {"limit", line.limit ? Json(*line.limit) : Json(nullptr)},
                    {"unit", line.unit},
                    {"sentence", line.sentence},
                    {"remedy", line.remedy.empty() ? Json(nullptr) : Json(line.remedy)}});
  return jsonText(rows);
}

// Every scene of the file against the device, before anybody holds it.
void checkOnDevice(const ValidateRequest& r, const session::Programme& programme) {
  std::vector<session::BlockScene> scenes;
  for (const std::vector<session::BlockScene>& block : programme.scenes) scenes.insert(scenes.end(), block.begin(), block.end());
  for (const session::BlockScene& scene : scenes) {
    const auto device = devices::makeDevice(r.device, scene.experiment, 0);
    const auto lines = devices::checkBeforeBlock(scene.experiment, *device);
    std::string names;
    for (const haptics::HapticDevice* hand : device->hands()) names += (names.empty() ? "" : " + ") + hand->info().name;
    if (r.json) fmt::print("{}", preflightJson(lines));
    else
      fmt::print("{}{} on {}:\n{}", scene.experiment.experiment().name, scene.target.empty() ? "" : ", " + scene.condition, names,
                 preflightText(lines));
  }
}

}  // namespace

void addValidateCommand(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("validate", "Check experiment files, constraint definitions, session plans and studies");
  const auto r = std::make_shared<ValidateRequest>();
  command->add_option("files", r->files, "Files to check, or names of shipped files. Every error of every file is reported at once")
      ->required();
  CLI::Option* device = command->add_option(
      "--device", r->device, "checks also what the experiment asks of this device: forces, stability, workspace; as for reach run");
  command->add_flag("--json", r->json, "with --device: an array of {hand, name, verdict, asked, limit, unit, sentence, remedy}")
      ->needs(device);
  command->footer(
      "Examples:\n  reach validate my-experiment.json\n  reach validate *.json\n  reach validate chain-fast --device virtual:omni");
  command->callback([r, &exitCode] {
    for (const std::string& file : r->files) {
      try {
        const auto programme = validateFile(file);
        if (programme) session::checkRecordable(*programme);
        if (!r->json) fmt::print("{}: fine\n", file);
        if (!r->device.empty()) checkOnDevice(*r, programme ? *programme : session::readProgramme(file));
      } catch (const FaultError& e) {
        fmt::print(stderr, "{}", messageOf(inOptionWords(e.faults)));
        exitCode = 2;
      } catch (const RefusedError& e) {
        fmt::print(stderr, "{}", messageOf(fileFault(file, e.what())));
        exitCode = 4;
      }
    }
  });
}

}  // namespace reachlab::cli
