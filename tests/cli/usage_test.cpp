#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "test_paths.h"
#include "tests/cli/program.h"

using namespace reachlab::test;
using Json = nlohmann::json;

namespace {

// Every command with its sub-commands, as the help lists them: two spaces, the word, and its meaning in column 30.
std::vector<std::string> commandsBelow(const std::string& command) {
  std::vector<std::string> all{command};
  std::istringstream lines(printed(command + " --help"));
  bool commands = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == ':') commands = line == "Subcommands:" || (command.empty() && line != "Options:");
    if (!commands || line.size() < 31 || !line.starts_with("  ") || line[2] < 'a' || line[2] > 'z' || line[29] != ' ') continue;
    for (const std::string& below : commandsBelow(command + (command.empty() ? "" : " ") + line.substr(2, line.find(' ', 2) - 2)))
      all.push_back(below);
  }
  return all;
}

}  // namespace

class Usage : public InAFolder {};

TEST_F(Usage, EveryCommandHasHelpOfOneForm) {
  printed("--version");
  const std::vector<std::string> commands = commandsBelow("");
  EXPECT_GE(commands.size(), 30u);
  for (const std::string& command : commands) {
    const std::string help = printed(command + " --help");
    EXPECT_EQ(printed("help " + command), help) << command;
    EXPECT_TRUE(holds(help, "  reach " + command)) << "no example of its own";
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);)
      EXPECT_LE(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; }), 100) << command << "\n" << line;
  }
}

TEST_F(Usage, HelpSaysWhichOptionsMustBeGiven) {
  const std::regex missing("(--\\S+): is missing");
  for (const char* command :
       {"run chain-slow", "export a.rlog", "predict dingwell", "simulate dingwell", "constraint eval torus", "peers init here"}) {
    const std::string refusal = reach(command).err;
    std::smatch option;
    ASSERT_TRUE(std::regex_search(refusal, option, missing)) << command << "\n" << refusal;
    const std::string help = printed(std::string(command) + " --help");
    const std::size_t at = help.find(option[1].str() + " ");
    EXPECT_LT(help.find("(required)", at), help.find("\n  -", at)) << command << " " << option[1];
  }
}

TEST_F(Usage, HelpShowsTheCommandsInTheOrderOfTheWork) {
  const std::string help = printed("help");
  std::size_t last = 0;
  for (const char* line :
       {"Record:", "  run ", "Inspect:", "  show ", "Understand:", "  predict ", "Prepare:", "  list ", "Measure:", "  bench "}) {
    const std::size_t at = help.find(line, last);
    ASSERT_NE(at, std::string::npos) << line << "\n" << help;
    last = at;
  }
  EXPECT_TRUE(says(reach("help simulat"), 2, "did you mean simulate?"));
}

TEST_F(Usage, MistakesAreAnsweredWithWhatWasMeant) {
  const std::string experiment = folder_.write("mine.json", R"({"schema_version": 1, "object": {}})");
  const std::string table = folder_.write("plain", "");
  struct Mistake {
    std::string arguments, answer;
    int exitCode = 2;
  };
  for (const Mistake& m :
       {Mistake{"run dingwell --devise simulated", "did you mean --device?"},
        Mistake{"run dingwell --device simulated --tirals=3", "did you mean --trials?"},
        Mistake{"run dingwell --device simulated --trial 3",
                "error: --trial: is not a known option\nhelp: did you mean --trials? `reach run --help` lists"},
        Mistake{"simulat dingwell", "error: simulat: is not a command\nhelp: did you mean simulate? Allowed: run, station"},
        Mistake{"", "error: a command is missing\nhelp: `reach --help` explains the commands. Allowed: run, station"},
        Mistake{"constraint",
                "error: constraint: a command is missing\nhelp: `reach constraint --help` explains the commands. Allowed: list, show"},
        Mistake{"list", "error: what: is missing\nhelp: allowed: experiments, "},
        Mistake{"run dingwell", "error: --device: is missing\nhelp: --device: "},
        Mistake{"run", "error: "},
        Mistake{"run nothing-like-it --device simulated", "error: "},
        Mistake{"simulate chain-moderate --hand fly", "error: "},
        Mistake{"list planets", "error: "},
        Mistake{"run chain-moderate --device teleport:x --fast", "error: "},
        Mistake{"run chain-moderate --device simulated --fast --subject a_b", "error: "},
        Mistake{"simulate chain-moderate --hand none --until -1", "error: "},
        Mistake{"run chain-moderate --device simulated --fast --trials 1 --age NaN --data not-made", "error: "},
        Mistake{"predict chain-moderate --criterion min-hand-jerk --duration nan", "error: "},
        Mistake{"predict chain-moderate --criterion min-hand-jerk --hand-mass nan", "error: "},
        Mistake{"simulate chain-moderate --hand min-jerk --until -inf", "error: "},
        Mistake{"predict paper --criterion min-hand-jerk", "paper.json: is a session plan, and an experiment is needed here"},
        Mistake{"run dingwell --device phantm",
                "error: --device: is phantm, which is unknown\nhelp: did you mean phantom? Allowed: simulated, partner, replay"},
        Mistake{"run dingwell --device virtual:omi",
                "error: --device: is virtual:omi, which is no model\nhelp: allowed: virtual:MODEL with MODEL one of omni"},
        Mistake{"run dingwell --device polhem:/dev/none", "device polhem:/dev/none: /dev/none: No such file", 3},
        Mistake{"run dingwell --device replay:/no-such.csv --fast --data " + data_, "error: ", 3},
        Mistake{"predict chain-slow --criterion 1", "(1) min-hand-jerk, (2) min-torque-change"},
        Mistake{"constraint check " + experiment, "is an experiment file, no constraint definition\nhelp: `reach validate` checks it"},
        Mistake{"run dingwell --device simulated --fast --seed 1 --data " + table + "/data", "--data: ", 3}}) {
    const Ended ended = reach(m.arguments);
    EXPECT_TRUE(says(ended, m.exitCode, m.answer)) << m.arguments;
    EXPECT_EQ(ended.out, "") << m.arguments << ": nothing was begun";
  }
}

TEST_F(Usage, PlansAndTheUsersOwnConstraintsAreListed) {
  EXPECT_TRUE(holds(printed("list plans"), "paper                    6 blocks"));
  folder_.write("bow.json", R"json({"schema_version": 1, "name": "bow", "sentence": "A bow.", "kind": "curve",
      "curve": ["phi", "phi^2", "0"], "domain": [-1, 1], "start": [0], "target": [0.5]})json");
  for (const char* command : {"list constraints", "constraint list"})
    EXPECT_TRUE(holds(printed(command, "REACHLAB_CONSTRAINTS=" + folder_.path()), "bow "));
}

TEST_F(Usage, RecoverGoesThroughAllItsLogs) {
  const std::string data = folder_.path();
  for (int i = 0; i < 2; ++i) printed("run dingwell --device simulated --trials 1 --seed 1 --fast --data " + data);
  const Ended ended = reach("recover " + data + "/sourcedata/none.reach " + data + "/sourcedata/*_log.reach");
  EXPECT_EQ(ended.exitCode, 3) << "one of them is not there";
  for (const char* run : {"run-01", "run-02"}) EXPECT_TRUE(holds(ended.out, std::string(run) + "_log.reach: healthy, 1 trials"));
  const Ended refused = reach("export " + data + " --format csv --out " + folder_.write("file", "") + "/x");
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(refused.err.starts_with("error: --out: ")) << refused.err;
}

TEST_F(Usage, EveryListHasNames) {
  for (const char* what : {"experiments", "constraints", "methods", "criteria", "devices"}) {
    const Json rows = printedJson(std::string("list --json ") + what);
    ASSERT_FALSE(rows.empty()) << what;
    for (const Json& row : rows) EXPECT_TRUE(row.at("name").is_string()) << what;
  }
}

const std::string kLine = R"({"name": "line"})";

TEST_F(Usage, ValidateRefusesTheTaskThatARunRefuses) {
  const std::string file = folder_.write("still.json", experimentOn(kLine, reachFrom("1", "1")));
  const Ended validated = reach("validate " + file);
  EXPECT_TRUE(says(validated, 2, "same position"));
  EXPECT_TRUE(says(reach("run " + file + " --device simulated --fast --seed 1 --data " + folder_.path()), 2, validated.err));
  EXPECT_EQ(reach("simulate " + file + " --hand hold --until 0.01").exitCode, 0) << "who only simulates needs no way";
}

TEST_F(Usage, ValidateWarnsOfNumbersThatAreHardlyMeant) {
  const Ended ended = reach("validate " + folder_.write("odd.json", experimentOn(kLine, reachFrom("1", "2", "90", "0.5"),
                                                                                 R"("kind": "point", "masses_kg": [150])")));
  for (const char* part : {"masses_kg[0]: is 150 kg", "duration_s: is 90 s", "position_m: is 0.5 m"}) EXPECT_TRUE(says(ended, 0, part));
}

TEST_F(Usage, ValidateTakesNamesAndSaysWhatItExpects) {
  for (const char* name : {"chain-moderate", "paper", "cardioid"}) {
    const Ended ended = reach(std::string("validate ") + name);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_EQ(ended.err, "") << "nothing shipped is odd";
  }
  for (const std::string& what : {folder_.path(), folder_.write("hand.csv", "time_s,x_m,y_m,z_m\n0,0,0,0\n")}) {
    EXPECT_TRUE(says(reach("validate " + what), 2, "allowed: an experiment file, a constraint definition, a session plan or a study"));
  }
  for (const char* name : {"chain-moderate", "paper"})
    EXPECT_EQ(shell("cd " + folder_.path() + " && mkdir -p " + name + " && $REACH validate " + name).exitCode, 0) << "a folder is no file";
  EXPECT_TRUE(holds(reach("validate chain-modrate").err, "did you mean chain-moderate?"));
  std::string old = experimentOn(kLine, reachFrom("1", "2"));
  old.replace(old.find(": 1"), 3, ": 2");
  EXPECT_TRUE(says(reach("validate " + folder_.write("old.json", old)), 2, "error: schema_version: is 2\n"));
}

TEST_F(Usage, ValidateAcceptsEveryShippedFile) {
  printed("validate " REACHLAB_SOURCE_DIR "/resources/experiments/*.json " REACHLAB_SOURCE_DIR
          "/resources/plans/*.json " REACHLAB_SOURCE_DIR "/constraints/definitions/*.json");
}

TEST_F(Usage, AnalyzeRefusesWhatWouldChangeNothing) {
  for (const auto& [given, of] : {std::pair{"--jobs 2", "--recovery"},
                                  {"--seed 3", "--recovery"},
                                  {"--onset-speed 0.02", "--onset absolute"},
                                  {"--onset task --onset-percent 3", "--onset percent"}})
    EXPECT_TRUE(says(reach(std::string("analyze . ") + given), 2, std::string("changes nothing without ") + of)) << given;
}
