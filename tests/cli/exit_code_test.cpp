#include "base/fault.h"
#include "cli/terminal/exit_code.h"

#include <gtest/gtest.h>

#include <vector>

#include "cli/terminal/option_words.h"
#include "tests/cli/program.h"

using namespace reachlab;

namespace {

struct Said {
  int code = 0;
  std::string words;
};

template <class Work>
Said endOf(Work&& work) {
  CLI::App app;
  testing::internal::CaptureStderr();
  const int code = cli::exitCodeOf(app, [&]() -> int {
    work();
    return 0;
  });
  return {code, testing::internal::GetCapturedStderr()};
}

}  // namespace

TEST(ExitCode, IsThatOfTheReportWhichIsPrinted) {
  EXPECT_EQ(endOf([] { throw FaultError(Fault{"x", "is bad"}); }).code, 2);
  EXPECT_EQ(endOf([] { throw ResourceError("no disk"); }).code, 3);
  EXPECT_EQ(endOf([] { throw RefusedError("stiff"); }).code, 4);
  EXPECT_EQ(endOf([] { throw RefusedError("stiff"); }).words, "error: stiff\n");
  const Said library = endOf([] { (void)std::vector<int>{1}.at(3); });
  EXPECT_EQ(library.code, 70);
  EXPECT_NE(library.words.find("fault of the program itself"), std::string::npos) << library.words;
}

TEST(OptionWords, TellAFaultOfTheRequestByItsOption) {
  EXPECT_EQ(endOf([] {
              throw FaultError(Fault{"participant.age", "is 200", "0 to 130 years"});
            }).words,
            "error: --age: is 200\nhelp: allowed: 0 to 130 years\n");
  EXPECT_EQ(cli::optionOf("disk_reserve"), "--disk-reserve");
  EXPECT_EQ(cli::optionOf("object.masses_kg"), "");
  const Said inFile = endOf([] { throw FaultError(Fault{"method", "is x", "auto", FilePlace{"e.json", 3, 4}}); });
  EXPECT_EQ(inFile.words, "e.json:3:4: error: method: is x\nhelp: allowed: auto\n") << "what stands in a file was not given by an option";
}

/// Every option of the table is one that some command has.
TEST(OptionWords, AreOptionsThatThereAre) {
  std::string help;
  for (const char* command : {"run", "predict", "simulate", "bench", "analyze"}) help += test::reach(std::string(command) + " --help").out;
  std::istringstream keys(
      "subject session trials run seed day data device fast resume disk_reserve sweep hand_mass unknowns duration hand_damping point scene "
      "method cutoff until participant.age participant.sex participant.handedness");
  for (std::string key; keys >> key;) {
    const std::string option = cli::optionOf(key);
    ASSERT_FALSE(option.empty()) << key;
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
}

TEST(OptionWords, AreWhatAPersonReads) {
  const TemporaryFolder folder;
  const std::string data = " --data " + folder.path();
  const test::Ended labels = test::reach("run dingwell --device simulated --fast --subject a_b --session c-d" + data);
  EXPECT_EQ(labels.exitCode, 2);
  EXPECT_EQ(labels.err,
            "error: --subject: \"a_b\" is not a label\nhelp: allowed: up to 60 letters and digits\n"
            "error: --session: \"c-d\" is not a label\nhelp: allowed: up to 60 letters and digits\n");
  EXPECT_TRUE(test::reach("predict chain-slow --criterion min-hand-jerk --sweep n=1:2")
                  .err.starts_with("error: --sweep: is n=1:2\nhelp: allowed: KEY=FROM"));
  EXPECT_TRUE(
      test::reach("predict ellipse --criterion min-hand-jerk --point behind-spring --unknowns 1").err.starts_with("error: --unknowns: "));
  EXPECT_TRUE(test::reach("bench --scene S99 --quick").err.starts_with("error: --scene: is S99\nhelp: allowed: S1"));
}
