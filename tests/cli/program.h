#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "test_paths.h"
#include "tests/in_a_folder.h"
#include "tests/refusal.h"

namespace reachlab::test {

using reachlab::holds;
using reachlab::InAFolder;
using reachlab::TemporaryFolder;

struct Ended {
  int exitCode = -1;
  std::string out, err;
};

inline std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return std::move(text).str();
}

/// Each message of a wrong command has the one form (base/terminal/message.h), and no text of a library in it. REACHLAB_MESSAGES names a file
/// that collects them (tests/cli/messages.py).
inline void expectTheOneForm(const std::string& arguments, const Ended& ended) {
  if (ended.exitCode < 2 || ended.exitCode > 4) return;
  static const std::regex head("(?:.+?(?::[0-9]+){0,2}: )?(?:error|warning): \\S.*"),
      below(" +[0-9]+ \\| .*| +\\| +\\^|help: \\S.*|note: .*");
  std::istringstream lines(ended.err);
  bool told = false;
  for (std::string line; std::getline(lines, line);) {
    const bool isHead = std::regex_match(line, head);
    told = told || (isHead && line.find("error: ") != std::string::npos);
    EXPECT_TRUE(!told || isHead || std::regex_match(line, below)) << "reach " << arguments << "\n" << ended.err;
  }
  EXPECT_TRUE(told) << "reach " << arguments << "\n" << ended.err;
  for (const char* foreign : {"not in range", "Could not convert", "required", "json.exception", "syntax error", "parse error",
                              "std::", "filesystem error", "bad_alloc", " INT", " FLOAT"})
    EXPECT_FALSE(holds(ended.err, foreign)) << "reach " << arguments;
  if (const char* list = std::getenv("REACHLAB_MESSAGES"))
    std::ofstream(list, std::ios::app) << "$ reach " << arguments << "\n" << ended.err;
}

/// Runs a command with nothing to read.
inline Ended endOf(const std::string& command) {
  const TemporaryFolder folder;
  const int status =
      std::system((command + " > \"" + (folder / "out").string() + "\" 2> \"" + (folder / "err").string() + "\" < /dev/null").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), contentOf(folder / "out"), contentOf(folder / "err")};
}

/// Runs `reach ARGUMENTS` in a shell; `environment` stands before it.
inline Ended reach(const std::string& arguments, const std::string& environment = "") {
  Ended ended = endOf(environment + " \"" REACH_PROGRAM "\" " + arguments);
  expectTheOneForm(arguments, ended);
  return ended;
}

/// What `reach ARGUMENTS` prints. It has to end with 0.
inline std::string printed(const std::string& arguments, const std::string& environment = "") {
  const Ended ended = reach(arguments, environment);
  EXPECT_EQ(ended.exitCode, 0) << "reach " << arguments << "\n" << ended.err << ended.out;
  return ended.out;
}
inline nlohmann::json printedJson(const std::string& arguments, const std::string& environment = "") {
  return nlohmann::json::parse(printed(arguments, environment));
}

/// Whether a command ended with this number, and these words are on its standard error.
inline testing::AssertionResult says(const Ended& ended, int exitCode, const std::string& words) {
  if (ended.exitCode == exitCode) return holds(ended.err, words);
  return testing::AssertionFailure() << "exit " << ended.exitCode << " for " << exitCode << "\n" << ended.err.substr(0, 4000);
}

/// Runs a line of bash in which $REACH is the program, for redirections, pipes and limits.
inline Ended shell(const std::string& line) {
  const TemporaryFolder folder;
  return endOf("bash \"" + folder.write("script", "REACH=\"" REACH_PROGRAM "\"\n" + line + "\n") + "\"");
}

inline std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  if (!line.empty() && line.back() == separator) parts.emplace_back();
  return parts;
}

/// Starts `reach` with nothing to read. Its standard output goes to this descriptor, or nowhere as its messages do.
inline pid_t start(std::vector<std::string> arguments, int out = -1) {
  arguments.insert(arguments.begin(), REACH_PROGRAM);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int null = ::open("/dev/null", O_RDWR);
  for (const int descriptor : {0, 1, 2}) ::dup2(descriptor == 1 && out >= 0 ? out : null, descriptor);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

/// An experiment's text: an object on a constraint, a point of 1 kg where nothing else is said, with a reach as `reachFrom` gives it or none.
inline std::string experimentOn(const std::string& constraint, const std::string& reach = "",
                                const std::string& object = R"("kind": "point", "masses_kg": [1])") {
  return R"({"schema_version": 1, "constraint": )" + constraint + R"(, "object": {)" + object +
         R"(}, "coupling": {"stiffness_n_per_m": 600, "damping_n_s_per_m": 5})" + reach + "}";
}
inline std::string reachFrom(const std::string& start, const std::string& target, const std::string& seconds = "1.35",
                             const std::string& tolerance = "0.012") {
  return R"(, "task": {"start": [)" + start + R"(], "target": [)" + target + R"(], "duration_s": )" + seconds +
         R"(, "tolerance": {"position_m": )" + tolerance + R"(, "velocity_m_per_s": 0.012, "time_s": 0.5}})";
}

/// A CSV with its header; cells as written.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t column(const std::string& name) const {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == name) return i;
    throw std::out_of_range("no column " + name);
  }
  double at(std::size_t row, const std::string& name) const { return std::strtod(rows.at(row).at(column(name)).c_str(), nullptr); }
};
inline Table parseCsv(const std::string& text) {
  Table table;
  std::istringstream in(text);
  std::string line;
  if (std::getline(in, line)) table.header = split(line, ',');
  while (std::getline(in, line)) table.rows.push_back(split(line, ','));
  return table;
}

/// The table of trials that `reach export` writes of a dataset or a log.
inline Table exportedTrials(const std::string& what) {
  const TemporaryFolder csv;
  const Ended exported = reach("export " + what + " --format csv --out " + csv.path());
  EXPECT_EQ(exported.exitCode, 0) << exported.err;
  EXPECT_EQ(exported.err, "") << "the log is damaged, or was not closed in order";
  return parseCsv(contentOf(csv / "trials.csv"));
}

/// The lines `trial=… outcome=…` of a run, each as its key=value pairs.
inline std::vector<std::map<std::string, std::string>> trialLines(const std::string& out) {
  std::vector<std::map<std::string, std::string>> trials;
  std::istringstream in(out);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("trial=", 0) != 0) continue;
    auto& trial = trials.emplace_back();
    for (const std::string& word : split(line, ' '))
      if (const auto equals = word.find('='); equals != std::string::npos) trial[word.substr(0, equals)] = word.substr(equals + 1);
  }
  return trials;
}

}  // namespace reachlab::test
